// The elementary detections between features named by their ids, in any scalar.
#pragma once

#include "chasles/culling/cached_face.h"
#include "chasles/elementary/edge_edge.h"
#include "chasles/elementary/edge_through_face.h"
#include "chasles/motion/screw_path.h"

namespace chasles::search {

using algebra::FeasibleInterval;
using algebra::Vector3;

/// Two bodies under one set of control maps.
template <class S>
class FeaturePairs {
public:
    FeaturePairs(const Body& moving, const Body& fixed, const elementary::Accuracy& accuracy)
        : moving_(moving), fixed_(fixed), accuracy_(accuracy) {}

    /// Sets the maps (kept by reference) and the tolerance of the interval that they run over.
    void use(const motion::ControlMaps<S>& maps, const algebra::Tolerance& tolerance) {
        maps_ = &maps;
        accuracy_.tolerance = tolerance;
    }

    std::optional<FeasibleInterval> vertex_face(std::uint32_t moving_vertex, std::uint32_t fixed_face) {
        const auto position = maps_->rotation * culling::point_of<S>(moving_, moving_vertex) + maps_->translation;
        return elementary::vertex_face<S>({position, maps_->weight}, face_.shape_of(fixed_, fixed_face), accuracy_,
                                          workspace_);
    }

    std::optional<FeasibleInterval> face_vertex(std::uint32_t moving_face, std::uint32_t fixed_vertex) {
        const auto position =
            maps_->rotation.transposed() * culling::point_of<S>(fixed_, fixed_vertex) - maps_->inverse_translation;
        return elementary::vertex_face<S>({position, maps_->weight}, face_.shape_of(moving_, moving_face), accuracy_,
                                          workspace_);
    }

    [[nodiscard]] elementary::EdgePath<S> path_of(const Edge& moving_edge) const {
        return elementary::edge_path(*maps_, culling::point_of<S>(moving_, moving_edge.from),
                                     culling::point_of<S>(moving_, moving_edge.to));
    }

    std::optional<FeasibleInterval> edge_edge(const elementary::EdgePath<S>& moving_edge, const Edge& fixed_edge) {
        const auto fixed = elementary::fixed_edge(culling::point_of<S>(fixed_, fixed_edge.from),
                                                  culling::point_of<S>(fixed_, fixed_edge.to));
        return elementary::edge_edge<S>(*maps_, moving_edge, fixed, accuracy_, workspace_);
    }

    /// At the start of the interval: a moving edge through a fixed face, in the fixed body's frame.
    std::optional<elementary::Passage<S>> moving_edge_passage(const Edge& edge, std::uint32_t fixed_face,
                                                              elementary::Ends ends) {
        const elementary::Segment<S> segment{
            start(maps_->rotation, culling::point_of<S>(moving_, edge.from), maps_->translation),
            start(maps_->rotation, culling::point_of<S>(moving_, edge.to), maps_->translation), maps_->weight[0]};
        return elementary::edge_through_face(segment, face_.shape_of(fixed_, fixed_face), accuracy_.scale, ends);
    }

    /// At the start of the interval: a fixed edge through a moving face, in the moving body's frame.
    std::optional<elementary::Passage<S>> fixed_edge_passage(const Edge& edge, std::uint32_t moving_face,
                                                             elementary::Ends ends) {
        const auto back = maps_->rotation.transposed();
        const auto shift = Vector3<Polynomial>() - maps_->inverse_translation;
        const elementary::Segment<S> segment{start(back, culling::point_of<S>(fixed_, edge.from), shift),
                                             start(back, culling::point_of<S>(fixed_, edge.to), shift),
                                             maps_->weight[0]};
        return elementary::edge_through_face(segment, face_.shape_of(moving_, moving_face), accuracy_.scale, ends);
    }

    [[nodiscard]] const elementary::Workspace<S>& workspace() const { return workspace_; }

private:
    using Polynomial = algebra::Bernstein<3, S>;

    /// The first control point.
    static Vector3<S> start(const algebra::Matrix3<Polynomial>& turn, const Vector3<S>& point,
                            const Vector3<Polynomial>& shift) {
        Vector3<S> result;
        for (int i = 0; i < 3; ++i)
            result[i] =
                turn.row[i][0][0] * point.x + turn.row[i][1][0] * point.y + turn.row[i][2][0] * point.z + shift[i][0];
        return result;
    }

    const Body& moving_;
    const Body& fixed_;
    elementary::Accuracy accuracy_;
    const motion::ControlMaps<S>* maps_ = nullptr;
    culling::CachedFace<S> face_;
    elementary::Workspace<S> workspace_;
};

} // namespace chasles::search
