#include "chasles/search/nearest_features.h"

#include "chasles/culling/face_separation.h"
#include "chasles/culling/split_nodes.h"
#include "chasles/culling/time_tree.h"
#include "chasles/search/owned_pairs.h"

#include <algorithm>
#include <functional>

namespace chasles::search {

namespace {

using contact::FeaturePair;
using Eigen::Vector3d;

/// Two nodes.
struct NodesAtRest {
    std::uint32_t moving;
    std::uint32_t fixed;
    double distance; ///< of their middles
    double gap;      ///< along the way between their middles: no points of the nodes are nearer to each other
};

/// The boxes of two hierarchies at rest.
class BoxesAtRest {
public:
    explicit BoxesAtRest(const contact::RelativeConfiguration& bodies)
        : moving_(bodies.moving().bvh()), fixed_(bodies.fixed().bvh()), place_(placement_of(bodies)),
          farthest_(place_.offset.norm() + moving_.radius() + fixed_.radius()), boxes_(place_, place_, slack()) {}

    [[nodiscard]] std::span<const BvhNode> moving_nodes() const { return moving_.nodes(); }
    [[nodiscard]] std::span<const BvhNode> fixed_nodes() const { return fixed_.nodes(); }
    /// No points of the bodies are farther apart.
    [[nodiscard]] double farthest() const { return farthest_; }

    void set_bound(double bound) { boxes_.set_margin(bound); }
    /// Whether points of two nodes of either body may be within the bound, in the order 00, 01, 10, 11.
    [[nodiscard]] culling::SweptBoxes::Windows within_bound(const culling::TwoNodes& moving,
                                                            const culling::TwoNodes& fixed) const {
        return boxes_.overlap_windows(moving, fixed, {});
    }
    [[nodiscard]] NodesAtRest placed(std::uint32_t moving_node, std::uint32_t fixed_node) const {
        const BoxMiddle moving = middle_of(moving_.nodes()[moving_node]), fixed = middle_of(fixed_.nodes()[fixed_node]);
        const Vector3d between =
            place_.rotation * moving.centre.cast<double>() + place_.offset - fixed.centre.cast<double>();
        const double distance = between.norm();
        const double reach = between.cwiseAbs().dot(fixed.half.cast<double>()) +
                             (place_.rotation.transpose() * between).cwiseAbs().dot(moving.half.cast<double>());
        return {moving_node, fixed_node, distance, distance > 0 ? distance - reach / distance - rounding() : 0};
    }

private:
    static culling::Placement placement_of(const contact::RelativeConfiguration& bodies) {
        culling::Placement place;
        for (int i = 0; i < 3; ++i)
            place.rotation.col(i) = bodies.turned(Vector3d::Unit(i));
        place.offset = bodies.moved(bodies.moving().bvh().centre()) - bodies.fixed().bvh().centre();
        return place;
    }

    [[nodiscard]] double rounding() const { return culling::float_rounding(farthest_, farthest_); }
    [[nodiscard]] culling::BoxSlack slack() const { return {rounding(), rounding(), 0}; }

    const Bvh& moving_;
    const Bvh& fixed_;
    culling::Placement place_;
    double farthest_;
    culling::SweptBoxes boxes_;
};

/// One search, depth first, the nearer nodes before the farther ones.
class NearestSearch {
public:
    NearestSearch(const contact::RelativeConfiguration& bodies, const NearestGoal& goal)
        : bodies_(bodies), goal_(goal), boxes_(bodies), separation_(bodies.moving(), bodies.fixed()),
          bound_(goal.bound) {
        separation_.use(culling::IntervalEnds(bodies.pose()));
    }

    std::optional<NearestFeatures> run() {
        boxes_.set_bound(std::min(bound_, boxes_.farthest()));
        stack_.push_back({0, 0, 0, 0});
        while (!stack_.empty() && std::max(work_.node_pairs, work_.face_pairs) < goal_.most_work) {
            const NodesAtRest nodes = stack_.back();
            stack_.pop_back();
            if (nodes.gap <= bound_)
                visit(nodes);
        }
        return found_;
    }
    [[nodiscard]] const Work& work() const { return work_; }

private:
    void visit(const NodesAtRest& nodes) {
        const BvhNode& moving = boxes_.moving_nodes()[nodes.moving];
        const BvhNode& fixed = boxes_.fixed_nodes()[nodes.fixed];
        if (moving.is_leaf() && fixed.is_leaf())
            return test({moving.first, fixed.first});
        const auto [a, b] =
            culling::split_nodes(boxes_.moving_nodes(), nodes.moving, boxes_.fixed_nodes(), nodes.fixed);
        const auto windows = boxes_.within_bound(a.of(boxes_.moving_nodes()), b.of(boxes_.fixed_nodes()));
        work_.node_pairs += std::uint64_t(a.count) * b.count;
        const std::size_t before = stack_.size();
        for (std::uint32_t i = 0; i < a.count; ++i)
            for (std::uint32_t j = 0; j < b.count; ++j)
                if (!windows[2 * i + j].is_empty())
                    stack_.push_back(boxes_.placed(a.first + i, b.first + j));
        const auto first = stack_.begin() + std::ptrdiff_t(before);
        for (auto next = first; next != stack_.end(); ++next) // insertion: at most four, and the same order everywhere
            std::rotate(std::ranges::upper_bound(first, next, next->distance, std::greater(), &NodesAtRest::distance),
                        next, next + 1);
    }

    void test(const TwoFaces& faces) {
        ++work_.face_pairs;
        if (separation_.direction(faces.moving, faces.fixed, 0, bound_))
            return;
        for_each_owned_pair<true>(bodies_.moving(), bodies_.fixed(), faces, AllFeatures(), AllFeatures(),
                                  [&](const FeaturePair& features) { test(features); });
    }

    void test(const FeaturePair& features) {
        const double distance = nearest_.points(bodies_, features).distance;
        if (!(distance < bound_))
            return;
        bound_ = goal_.accuracy * distance;
        boxes_.set_bound(bound_);
        found_ = {features, distance};
    }

    const contact::RelativeConfiguration& bodies_;
    const NearestGoal& goal_;
    BoxesAtRest boxes_;
    culling::FaceSeparation separation_;
    NearestAtRest nearest_;
    double bound_;
    std::vector<NodesAtRest> stack_;
    std::optional<NearestFeatures> found_;
    Work work_;
};

} // namespace

NearPoints NearestAtRest::points(const contact::RelativeConfiguration& bodies, const FeaturePair& features) {
    const auto apart = [](const contact::NearestPoints& points, double error) {
        return NearPoints{points, points.apart().norm() + error};
    };
    if (features.kind == ContactKind::vertex_face) {
        const Vector3d vertex = bodies.moved(bodies.moving().vertices()[features.moving.first]);
        const contact::FaceAtRest& face = fixed_face_.of(bodies.fixed(), features.fixed.first);
        return apart({vertex, face.nearest(vertex)}, face.nearest_error());
    }
    if (features.kind == ContactKind::face_vertex) {
        const Vector3d& vertex = bodies.fixed().vertices()[features.fixed.first];
        const contact::FaceAtRest& face = moving_face_.of(bodies.moving(), features.moving.first);
        return apart({bodies.moved(face.nearest(bodies.moved_back(vertex))), vertex}, face.nearest_error());
    }
    return apart(bodies.nearest(features), 0);
}

std::optional<NearestFeatures> nearest_features(const contact::RelativeConfiguration& bodies, const NearestGoal& goal,
                                                Work& work) {
    NearestSearch search(bodies, goal);
    const auto found = search.run();
    work += search.work();
    return found;
}

} // namespace chasles::search
