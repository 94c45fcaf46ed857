// The detections with a margin between features named by their ids, in any scalar with division.
// Source: docs/derivations/16-margin.md.
#pragma once

#include "chasles/elementary/distance_tests.h"
#include "chasles/search/candidate.h"

namespace chasles::search {

/// When features that were farther apart come within the margin, or when they leave it.
struct Crossing {
    FeasibleInterval tau; ///< in terms of the interval that was asked about
    bool leaves = false;  ///< proven to be within the margin before
};

/// Asks for the first tau at which the distance is the margin.
class FirstCrossing {
public:
    explicit FirstCrossing(const algebra::Tolerance& tolerance) : tolerance_(tolerance) {}

    template <int Degree, class S>
    void operator()(const algebra::FeasibilityProblem<Degree, S>& problem) {
        const auto tau = algebra::first_feasible(problem, tolerance_);
        if (!tau || (first_ && first_->tau.lower <= tau->lower))
            return;
        const S lower(tau->lower);
        const S band = problem.function.error * value_at(problem.weight, lower);
        first_ = {*tau, value_at(problem.function.polynomial, lower) < S(0) - band};
    }
    [[nodiscard]] const std::optional<Crossing>& first() const { return first_; }

private:
    algebra::Tolerance tolerance_;
    std::optional<Crossing> first_;
};

/// Asks whether the distance is within the margin at the start of the interval.
class WithinAtStart {
public:
    enum class Answer : std::uint8_t { no, may_be, yes };

    template <int Degree, class S>
    void operator()(const algebra::FeasibilityProblem<Degree, S>& problem) {
        const S zero(0);
        const auto see = [&](const S& value, const algebra::Bounded<Degree, S>& bounded) {
            const S band = bounded.error * problem.weight[0];
            return value > band ? Answer::yes : value < zero - band ? Answer::no : Answer::may_be;
        };
        Answer answer = see(zero - problem.function.polynomial[0], problem.function);
        for (const auto& constraint : problem.constraints)
            answer = std::min(answer, see(constraint.first.polynomial[0], constraint.first));
        answer_ = std::max(answer_, answer);
    }
    [[nodiscard]] Answer answer() const { return answer_; }

private:
    Answer answer_ = Answer::no;
};

/// Two bodies under one set of control maps. `ask` is what elementary/near_features.h calls.
template <class S>
class NearPairs {
public:
    NearPairs(const Body& moving, const Body& fixed, const elementary::ErrorScale& scale, double margin)
        : moving_(moving), fixed_(fixed), accuracy_{scale, {}}, margin_(margin) {}

    /// Sets the maps, which are kept by reference.
    void use(const motion::ControlMaps<S>& maps) { maps_ = &maps; }

    template <class Ask>
    void vertex_face(std::uint32_t moving_vertex, std::uint32_t fixed_face, Ask ask) {
        const Path path = path_of_moving(moving_vertex);
        elementary::vertex_face_distance<S>(seen(path), face_.shape_of(fixed_, fixed_face), margin_, accuracy_,
                                            workspace_, ask);
    }
    template <class Ask>
    void face_vertex(std::uint32_t moving_face, std::uint32_t fixed_vertex, Ask ask) {
        const Path path = path_of_fixed(fixed_vertex);
        elementary::vertex_face_distance<S>(seen(path), face_.shape_of(moving_, moving_face), margin_, accuracy_,
                                            workspace_, ask);
    }
    template <class Ask>
    void vertex_edge(std::uint32_t moving_vertex, const Edge& fixed_edge, Ask ask) {
        const Path path = path_of_moving(moving_vertex);
        elementary::vertex_edge_distance<S>(seen(path), resting(fixed_, fixed_edge), margin_, accuracy_, workspace_,
                                            ask);
    }
    template <class Ask>
    void edge_vertex(const Edge& moving_edge, std::uint32_t fixed_vertex, Ask ask) {
        const Path path = path_of_fixed(fixed_vertex);
        elementary::vertex_edge_distance<S>(seen(path), resting(moving_, moving_edge), margin_, accuracy_, workspace_,
                                            ask);
    }
    template <class Ask>
    void vertex_vertex(std::uint32_t moving_vertex, std::uint32_t fixed_vertex, Ask ask) {
        const Path path = path_of_moving(moving_vertex);
        elementary::vertex_vertex_distance<S>(seen(path), culling::point_of<S>(fixed_, fixed_vertex), margin_,
                                              accuracy_, workspace_, ask);
    }
    template <class Ask>
    void edge_edge(const Edge& moving_edge, const Edge& fixed_edge, Ask ask) {
        const auto moving = elementary::edge_path(*maps_, culling::point_of<S>(moving_, moving_edge.from),
                                                  culling::point_of<S>(moving_, moving_edge.to));
        const auto fixed = elementary::fixed_edge(culling::point_of<S>(fixed_, fixed_edge.from),
                                                  culling::point_of<S>(fixed_, fixed_edge.to));
        elementary::edge_edge_distance<S>({*maps_, moving, fixed}, margin_, accuracy_, workspace_, ask);
    }

    /// The features of any kind.
    template <class Ask>
    void pair(const contact::FeaturePair& features, Ask ask) {
        const Edge moving{features.moving.first, features.moving.second};
        const Edge fixed{features.fixed.first, features.fixed.second};
        switch (features.kind) {
        case ContactKind::vertex_face:
            return vertex_face(moving.from, fixed.from, ask);
        case ContactKind::face_vertex:
            return face_vertex(moving.from, fixed.from, ask);
        case ContactKind::edge_edge:
            return edge_edge(moving, fixed, ask);
        case ContactKind::vertex_edge:
            return vertex_edge(moving.from, fixed, ask);
        case ContactKind::edge_vertex:
            return edge_vertex(moving, fixed.from, ask);
        case ContactKind::vertex_vertex:
            return vertex_vertex(moving.from, fixed.from, ask);
        }
    }

    [[nodiscard]] const elementary::Workspace<S>& workspace() const { return workspace_; }

private:
    using Path = Vector3<algebra::Bernstein<3, S>>;

    [[nodiscard]] elementary::VertexPath<S> seen(const Path& path) const { return {path, maps_->weight}; }
    [[nodiscard]] Path path_of_moving(std::uint32_t vertex) const {
        return maps_->rotation * culling::point_of<S>(moving_, vertex) + maps_->translation;
    }
    [[nodiscard]] Path path_of_fixed(std::uint32_t vertex) const {
        return maps_->rotation.transposed() * culling::point_of<S>(fixed_, vertex) - maps_->inverse_translation;
    }
    static elementary::RestingEdge<S> resting(const Body& body, const Edge& edge) {
        return elementary::resting_edge(culling::point_of<S>(body, edge.from), culling::point_of<S>(body, edge.to));
    }

    const Body& moving_;
    const Body& fixed_;
    elementary::Accuracy accuracy_;
    elementary::Margin<S> margin_;
    const motion::ControlMaps<S>* maps_ = nullptr;
    culling::CachedFace<S> face_;
    elementary::Workspace<S> workspace_;
};

} // namespace chasles::search
