#include "chasles/search/nearest_features.h"

#include "chasles/culling/face_separation.h"
#include "chasles/culling/swept_boxes.h"
#include "chasles/search/owned_pairs.h"

#include <algorithm>
#include <array>

namespace chasles::search {

namespace {

using contact::FeaturePair;
using Eigen::Vector3d;

/// Two nodes, by the distance of their middles.
struct NodesAtRest {
    std::uint32_t moving;
    std::uint32_t fixed;
    double distance;
};

/// The boxes of two hierarchies at rest.
class BoxesAtRest {
public:
    explicit BoxesAtRest(const contact::RelativeConfiguration& bodies)
        : moving_(bodies.moving().bvh()), fixed_(bodies.fixed().bvh()), place_(placement_of(bodies)),
          farthest_(place_.offset.norm() + moving_.radius() + fixed_.radius()),
          boxes_(place_, place_, {rounding * farthest_, rounding * farthest_, 0}) {}

    [[nodiscard]] const BvhNode& moving(std::uint32_t node) const { return moving_.nodes()[node]; }
    [[nodiscard]] const BvhNode& fixed(std::uint32_t node) const { return fixed_.nodes()[node]; }
    /// No points of the bodies are farther apart.
    [[nodiscard]] double farthest() const { return farthest_; }

    [[nodiscard]] const Eigen::Matrix3d& turn() const { return place_.rotation; }

    void set_bound(double bound) { boxes_.set_margin(bound); }
    /// Whether points of two nodes of either body may be within the bound, in the order 00, 01, 10, 11.
    [[nodiscard]] culling::SweptBoxes::Windows within_bound(const culling::TwoNodes& moving,
                                                            const culling::TwoNodes& fixed) const {
        return boxes_.overlap_windows(moving, fixed, {});
    }
    [[nodiscard]] NodesAtRest placed(std::uint32_t moving_node, std::uint32_t fixed_node) const {
        const Vector3d between = place_.rotation * middle_of(moving(moving_node)).centre.cast<double>() +
                                 place_.offset - middle_of(fixed(fixed_node)).centre.cast<double>();
        return {moving_node, fixed_node, between.norm()};
    }

private:
    static constexpr double rounding = 0x1p-16; // as in culling/time_tree.cpp

    static culling::Placement placement_of(const contact::RelativeConfiguration& bodies) {
        culling::Placement place;
        for (int i = 0; i < 3; ++i)
            place.rotation.col(i) = bodies.turned(Vector3d::Unit(i));
        place.offset = bodies.moved(bodies.moving().bvh().centre()) - bodies.fixed().bvh().centre();
        return place;
    }

    const Bvh& moving_;
    const Bvh& fixed_;
    culling::Placement place_;
    double farthest_;
    culling::SweptBoxes boxes_;
};

const contact::FaceAtRest& face_of(const Body& body, std::uint32_t face, std::optional<contact::FaceAtRest>& last) {
    if (!last || last->face() != face)
        last.emplace(body, face);
    return *last;
}

/// All features of a face, as the filter of owned pairs.
struct WholeFace {
    [[nodiscard]] static bool may_meet(std::uint32_t /*vertex*/) { return true; }
    [[nodiscard]] static bool may_meet(const Edge& /*edge*/) { return true; }
};

/// One search, depth first, the nearer nodes before the farther ones.
class NearestSearch {
public:
    NearestSearch(const contact::RelativeConfiguration& bodies, double bound, double accuracy)
        : bodies_(bodies), boxes_(bodies), separation_(bodies.moving(), bodies.fixed()), bound_(bound),
          accuracy_(accuracy) {
        separation_.use({boxes_.turn(), bodies.moved(Vector3d::Zero())});
    }

    std::optional<NearestFeatures> run() {
        boxes_.set_bound(std::min(bound_, boxes_.farthest()));
        stack_.push_back({0, 0, 0});
        while (!stack_.empty() && work_.node_pairs < most_visits) {
            const NodesAtRest nodes = stack_.back();
            stack_.pop_back();
            visit(nodes);
        }
        return found_;
    }
    [[nodiscard]] const Work& work() const { return work_; }

private:
    /// A greater distance than the least one makes a search slower, and no answer wrong.
    static constexpr std::uint64_t most_visits = 1 << 15;

    void visit(const NodesAtRest& nodes) {
        const BvhNode& moving = boxes_.moving(nodes.moving);
        const BvhNode& fixed = boxes_.fixed(nodes.fixed);
        if (moving.is_leaf() && fixed.is_leaf())
            return test({moving.first, fixed.first});
        const std::uint32_t first_moving = moving.is_leaf() ? nodes.moving : moving.first;
        const std::uint32_t last_moving = moving.is_leaf() ? nodes.moving : moving.first + 1;
        const std::uint32_t first_fixed = fixed.is_leaf() ? nodes.fixed : fixed.first;
        const std::uint32_t last_fixed = fixed.is_leaf() ? nodes.fixed : fixed.first + 1;
        const auto windows = boxes_.within_bound({&boxes_.moving(first_moving), &boxes_.moving(last_moving)},
                                                 {&boxes_.fixed(first_fixed), &boxes_.fixed(last_fixed)});
        const std::size_t before = stack_.size();
        for (std::uint32_t i = first_moving; i <= last_moving; ++i)
            for (std::uint32_t j = first_fixed; j <= last_fixed; ++j, ++work_.node_pairs)
                if (!windows[2 * (i - first_moving) + (j - first_fixed)].is_empty())
                    stack_.push_back(boxes_.placed(i, j));
        std::ranges::sort(stack_.begin() + std::ptrdiff_t(before), stack_.end(), std::greater(),
                          &NodesAtRest::distance);
    }

    void test(const TwoFaces& faces) {
        ++work_.face_pairs;
        if (separation_.direction(faces.moving, faces.fixed, 0, bound_))
            return;
        for_each_owned_pair<true>(bodies_.moving(), bodies_.fixed(), faces, WholeFace(), WholeFace(),
                                  [&](const FeaturePair& features) { test(features); });
    }

    void test(const FeaturePair& features) {
        const double distance = nearest_.distance(bodies_, features);
        if (!(distance < bound_))
            return;
        bound_ = accuracy_ * distance;
        boxes_.set_bound(bound_);
        found_ = {features, distance};
    }

    const contact::RelativeConfiguration& bodies_;
    BoxesAtRest boxes_;
    culling::FaceSeparation separation_;
    NearestAtRest nearest_;
    double bound_;
    double accuracy_;
    std::vector<NodesAtRest> stack_;
    std::optional<NearestFeatures> found_;
    Work work_;
};

} // namespace

contact::NearestPoints NearestAtRest::points(const contact::RelativeConfiguration& bodies,
                                             const FeaturePair& features) {
    if (features.kind == ContactKind::vertex_face) {
        const Vector3d vertex = bodies.moved(bodies.moving().vertices()[features.moving.first]);
        return {vertex, face_of(bodies.fixed(), features.fixed.first, fixed_face_).nearest(vertex)};
    }
    if (features.kind == ContactKind::face_vertex) {
        const Vector3d& vertex = bodies.fixed().vertices()[features.fixed.first];
        const contact::FaceAtRest& face = face_of(bodies.moving(), features.moving.first, moving_face_);
        return {bodies.moved(face.nearest(bodies.moved_back(vertex))), vertex};
    }
    return bodies.nearest(features);
}

double NearestAtRest::distance(const contact::RelativeConfiguration& bodies, const FeaturePair& features) {
    const double distance = points(bodies, features).apart().norm();
    switch (features.kind) {
    case ContactKind::vertex_face:
        return distance + fixed_face_->nearest_error();
    case ContactKind::face_vertex:
        return distance + moving_face_->nearest_error();
    default:
        return distance;
    }
}

std::optional<NearestFeatures> nearest_features(const contact::RelativeConfiguration& bodies, double bound,
                                                double accuracy, Work& work) {
    NearestSearch search(bodies, bound, accuracy);
    const auto found = search.run();
    work += search.work();
    return found;
}

} // namespace chasles::search
