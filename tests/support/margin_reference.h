// The exact first tau at which the distance of two moving polyhedral surfaces is a margin: all pairs of features in
// exact arithmetic, except for pairs that boxes separate. This header shares no code with chasles/.
#pragma once

#include "tests/support/exact_reference.h"
#include "tests/support/margin_reference_boxes.h"
#include "tests/support/margin_reference_pairs.h"

namespace chasles::reference {

/// Two bodies under one motion, and a margin above 0.
class MarginScene {
public:
    MarginScene(const Surface& moving, const Surface& fixed, const MotionPath<Rational>& motion, double margin)
        : features_{features_of(moving), features_of(fixed)} {
        WholeUnit unit;
        unit.cover(Eigen::Vector3d(margin, 0, 0));
        for (const Surface* surface : {&moving, &fixed})
            for (const Eigen::Vector3d& v : surface->vertices)
                unit.cover(v);
        motion_ = MarginMotion(whole_numbers(motion, unit.bits), unit.whole({margin, 0, 0})[0]);
        for (const Eigen::Vector3d& v : moving.vertices)
            points_[0].push_back(moved(motion_.path, unit.whole(v)));
        for (const Eigen::Vector3d& v : fixed.vertices)
            points_[1].push_back(standing(motion_.path, unit.whole(v)));
        boxes_ = MarginBoxes(moving.vertices, fixed.vertices, motion, margin);
    }

    /// Whether the surfaces are at most the margin apart at tau = 0. Surfaces that cross are.
    [[nodiscard]] bool is_within_at_start() {
        const CellBoxes at_start = boxes_.at_start();
        const std::vector<FeaturePair> near = kept(pairs_of(with_passages), at_start);
        return std::any_of(near.begin(), near.end(), [&](const FeaturePair& pair) {
            ++work_.exact;
            return visit(pair, [](const auto& question) { return reference::is_within_at_start(question); }) ||
                   passes_through(pair);
        });
    }

    /// The first tau in [0, 1] at which the surfaces are at most the margin apart.
    [[nodiscard]] std::optional<Root> first_time() {
        if (is_within_at_start())
            return Root::point(0, 0);
        const std::vector<FeaturePair> pairs = pairs_of(with_distance);
        work_.pairs += pairs.size();
        return first_in({Integer(0), 0}, boxes_.whole(), pairs);
    }

    [[nodiscard]] const ReferenceWork& work() const { return work_; }

private:
    static constexpr unsigned deepest = 12;
    static constexpr std::size_t few_pairs = 4;

    /// Vertices, edges and triangles, in this order.
    static std::vector<MarginFeature> features_of(const Surface& surface) {
        std::vector<MarginFeature> result;
        for (const std::uint32_t v : surface.corners)
            result.push_back({1, {v, v, v}});
        for (const auto& e : surface.edges)
            result.push_back({2, {e[0], e[1], e[1]}});
        for (const auto& t : surface.triangles)
            result.push_back({3, t});
        return result;
    }

    /// The largest number of vertices of a feature pair with a distance test. An edge and a triangle have five
    /// vertices; such a pair is only tested for crossing at the start.
    static constexpr std::size_t with_distance = 4;
    static constexpr std::size_t with_passages = 5;

    [[nodiscard]] std::vector<FeaturePair> pairs_of(std::size_t most_vertices) const {
        std::vector<FeaturePair> result;
        for (std::uint32_t i = 0; i < features_[0].size(); ++i)
            for (std::uint32_t j = 0; j < features_[1].size(); ++j)
                if (features_[0][i].size + features_[1][j].size <= most_vertices)
                    result.push_back({i, j});
        return result;
    }

    [[nodiscard]] std::vector<FeaturePair> kept(const std::vector<FeaturePair>& pairs, const CellBoxes& cell) const {
        std::array<std::vector<Box>, 2> around;
        for (std::size_t body = 0; body < 2; ++body)
            for (const MarginFeature& feature : features_[body])
                around[body].push_back(boxes_.around(cell, body, feature));
        std::vector<FeaturePair> result;
        for (const FeaturePair& pair : pairs)
            if (!boxes_.are_farther_apart(around[0][pair.moving], around[1][pair.fixed]) &&
                !boxes_.are_separated(cell, features_[0][pair.moving], features_[1][pair.fixed]))
                result.push_back(pair);
        return result;
    }

    std::optional<Root> first_in(const Cell& cell, const CellBoxes& boxes, const std::vector<FeaturePair>& pairs) {
        const std::vector<FeaturePair> near = kept(pairs, boxes);
        if (near.empty())
            return std::nullopt;
        if (cell.depth == deepest || near.size() <= few_pairs)
            return first_of(near, cell);
        const auto [left, right] = boxes.halves();
        if (auto found = first_in({2 * cell.from, cell.depth + 1}, left, near))
            return found;
        return first_in({2 * cell.from + 1, cell.depth + 1}, right, near);
    }

    std::optional<Root> first_of(const std::vector<FeaturePair>& pairs, const Cell& cell) {
        Earliest earliest;
        for (const FeaturePair& pair : pairs)
            visit(pair, [&](const auto& question) {
                ++work_.exact;
                offer_margin(earliest, question, cell);
                return true;
            });
        return earliest.first();
    }

    /// Calls ask() with the margin problem of two features. Returns false for an edge and a triangle, which have none.
    template <class Ask>
    bool visit(const FeaturePair& pair, Ask ask) const {
        const MarginFeature& a = features_[0][pair.moving];
        const MarginFeature& b = features_[1][pair.fixed];
        const auto of_a = [&](std::size_t i) -> const PointPath& { return points_[0][a.vertices[i]]; };
        const auto of_b = [&](std::size_t i) -> const PointPath& { return points_[1][b.vertices[i]]; };
        if (a.size == 1 && b.size == 1)
            return ask(VerticesMargin{motion_, of_a(0), of_b(0)});
        if (a.size == 1 && b.size == 2)
            return ask(VertexEdgeMargin{motion_, of_a(0), of_b(0), of_b(1), false});
        if (a.size == 2 && b.size == 1)
            return ask(VertexEdgeMargin{motion_, of_b(0), of_a(0), of_a(1), true});
        if (a.size == 2 && b.size == 2)
            return ask(EdgesMargin{motion_, of_a(0), of_a(1), of_b(0), of_b(1)});
        if (a.size == 1 && b.size == 3)
            return ask(VertexTriangleMargin{motion_, of_a(0), {&of_b(0), &of_b(1), &of_b(2)}, false});
        if (a.size == 3 && b.size == 1)
            return ask(VertexTriangleMargin{motion_, of_b(0), {&of_a(0), &of_a(1), &of_a(2)}, true});
        return false;
    }

    /// Whether an edge passes through a triangle at the start.
    [[nodiscard]] bool passes_through(const FeaturePair& pair) const {
        const MarginFeature& a = features_[0][pair.moving];
        const MarginFeature& b = features_[1][pair.fixed];
        if (a.size + b.size != 5)
            return false;
        const bool edge_moves = a.size == 2;
        const auto at_start = [&](std::size_t body, std::uint32_t vertex) {
            const PointPath& p = points_[body][vertex];
            return Point{p.path[0][0], p.path[1][0], p.path[2][0]};
        };
        const MarginFeature& edge = edge_moves ? a : b;
        const MarginFeature& triangle = edge_moves ? b : a;
        std::array<Point, 5> at;
        for (std::size_t i = 0; i < 2; ++i)
            at[i] = at_start(edge_moves ? 0 : 1, edge.vertices[i]);
        for (std::size_t i = 0; i < 3; ++i)
            at[2 + i] = at_start(edge_moves ? 1 : 0, triangle.vertices[i]);
        return segment_meets_triangle(at[0], at[1], {&at[2], &at[3], &at[4]});
    }

    std::array<std::vector<MarginFeature>, 2> features_; ///< of the moving body, of the fixed one
    MarginMotion motion_;
    std::array<std::vector<PointPath>, 2> points_;
    MarginBoxes boxes_;
    ReferenceWork work_;
};

} // namespace chasles::reference
