// Visits pairs of large nodes in space and time, with a small budget and without memory from the heap.
// Source: docs/derivations/23-coarse-motion.md.
#include "chasles/culling/clearly_apart.h"

#include "chasles/culling/coarse_scene.h"
#include "chasles/culling/near_nodes.h"
#include "chasles/culling/nested_boxes.h"
#include "chasles/culling/pair_queue.h"
#include "chasles/culling/plane_between.h"
#include "chasles/culling/split_nodes.h"
#include "chasles/culling/time_tree.h"

#include <algorithm>
#include <array>
#include <optional>

namespace chasles::culling {

namespace {

using motion::CoarseMotion;

// These numbers decide only when the test gives up. They are measured with clear_bench and peers_bench.

/// The number of splits after which the test gives up.
constexpr int most_splits = 16;
/// The number of times that an interval is halved.
constexpr int most_halvings = 3;
/// The interval of a pair is halved if its boxes are widened by more than this fraction of their longest side plus this
/// fraction of the margin.
constexpr double widening_of_side = 0.1;
constexpr double widening_of_margin = 0.3;

/// A stack of pairs of nodes that does not grow.
class PairStack {
public:
    [[nodiscard]] bool is_empty() const { return count_ == 0; }
    /// False if the stack is full.
    bool push(const NodePair& pair) {
        if (count_ == pairs_.size())
            return false;
        pairs_[count_++] = pair;
        return true;
    }
    NodePair pop() { return pairs_[--count_]; }

private:
    std::array<NodePair, 24> pairs_; // NOLINT(cppcoreguidelines-pro-type-member-init): the first count_ are set
    std::size_t count_ = 0;
};

/// A part of the motion with the placements at both ends.
struct Part {
    TimeRange range;
    Placement start;
    Placement end;
    int halvings = 0;
};

class CoarseTest {
public:
    explicit CoarseTest(const CoarseScene& scene)
        : scene_(scene), bounds_(scene),
          least_side_(small_side * std::min(size_of(scene.moving.bvh()), size_of(scene.fixed.bvh()))) {}

    /// Whether all nodes are proven apart during the part.
    bool separates_all(const Part& part) {
        PairStack roots;
        roots.push({0, 0, {}});
        return separates(roots, part);
    }

private:
    bool separates(PairStack& pairs, const Part& part);
    bool separates_in_halves(PairStack& deferred, const Part& part);
    bool split(const NodePair& pair, const SweptBoxes& boxes, PairStack& pairs);

    const CoarseScene& scene_;
    CoarseBounds bounds_;
    double least_side_; ///< pairs of nodes below this size are not split
    int splits_ = 0;
};

/// Whether all pairs of the stack are proven apart during the part.
bool CoarseTest::separates(PairStack& pairs, const Part& part) {
    const BoxSlack widening = bounds_.slack(part.range, part.start, part.end);
    const double most = std::max(widening.moving, widening.fixed) - widening_of_margin * scene_.margin;
    std::optional<SweptBoxes> boxes; // made only if a pair is not deferred
    PairStack deferred;
    while (!pairs.is_empty()) {
        const NodePair pair = pairs.pop();
        const BvhNode& moving = scene_.moving.bvh().nodes()[pair.moving];
        const BvhNode& fixed = scene_.fixed.bvh().nodes()[pair.fixed];
        const double side = std::max(longest_side(moving), longest_side(fixed));
        if (part.halvings < most_halvings && most > widening_of_side * side) {
            if (!deferred.push(pair))
                return false;
            continue;
        }
        if (side < least_side_ || (moving.is_leaf() && fixed.is_leaf()))
            return false;
        if (!boxes)
            boxes.emplace(part.start, part.end, widening);
        if (!split(pair, *boxes, pairs))
            return false;
    }
    return deferred.is_empty() || separates_in_halves(deferred, part);
}

bool CoarseTest::separates_in_halves(PairStack& deferred, const Part& part) {
    const double middle = part.range.at(0.5);
    const Placement between = scene_.placement(middle);
    PairStack earlier, later;
    while (!deferred.is_empty()) {
        const NodePair pair = deferred.pop();
        for (const bool is_later : {false, true})
            if (const Window when = in_half(pair.when, is_later); !when.is_empty())
                (is_later ? later : earlier).push({pair.moving, pair.fixed, when});
    }
    const int halvings = part.halvings + 1;
    return separates(earlier, {{part.range.lower, middle}, part.start, between, halvings}) &&
           separates(later, {{middle, part.range.upper}, between, part.end, halvings});
}

/// Pushes the pairs of children that are not proven apart. False if there are too many.
bool CoarseTest::split(const NodePair& pair, const SweptBoxes& boxes, PairStack& pairs) {
    if (++splits_ > most_splits)
        return false;
    const std::span<const BvhNode> moving = scene_.moving.bvh().nodes();
    const std::span<const BvhNode> fixed = scene_.fixed.bvh().nodes();
    const auto [a, b] = split_nodes(moving, pair.moving, fixed, pair.fixed);
    const auto when = boxes.overlap_windows(a.of(moving), b.of(fixed), pair.when);
    for (std::uint32_t i = 0; i < a.count; ++i)
        for (std::uint32_t j = 0; j < b.count; ++j)
            if (const Window& window = when[2 * i + j]; !window.is_empty())
                if (!pairs.push({a.first + i, b.first + j, window}))
                    return false;
    return true;
}

bool have_large_nodes_apart(const CoarseScene& scene, const Placement& start, const Placement& end) {
    const auto are_near = [&](const Placement& placed) {
        return have_near_nodes(scene.moving.bvh(), scene.fixed.bvh(), placed, scene.margin);
    };
    return !are_near(start) && !are_near(end) && CoarseTest(scene).separates_all({{}, start, end});
}

} // namespace

bool are_clearly_apart(const Body& moving, const Body& fixed, const CoarseMotion& motion, double margin) {
    const CoarseScene scene{moving, fixed, motion, distance_of_polyhedra(moving, fixed, margin)};
    const Placement start = scene.placement(0);
    const Placement end = scene.placement(1);
    return (have_large_nodes_apart(scene, start, end) &&
            !may_be_nested({moving, fixed, start, scene.start_deviation()})) ||
           have_plane_between(scene, start, end);
}

bool are_clearly_apart(const Body& moving, const Body& fixed, const motion::AnyTrajectory& trajectory, double margin) {
    for (std::size_t part = 0; part < trajectory.coarse_count(); ++part) {
        const std::optional<CoarseMotion> motion = trajectory.coarse(part);
        if (!motion || !are_clearly_apart(moving, fixed, *motion, margin))
            return false;
    }
    return true;
}

} // namespace chasles::culling
