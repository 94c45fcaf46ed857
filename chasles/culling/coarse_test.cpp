// Visits pairs of large nodes in space and time, with no memory from the heap and with a small budget.
// Source: docs/derivations/21-coarse-motion.md.
#include "chasles/culling/coarse_test.h"

#include "chasles/culling/body_ball.h"
#include "chasles/culling/node_split.h"
#include "chasles/culling/time_tree.h"

#include <algorithm>
#include <array>
#include <optional>

namespace chasles::culling {

namespace {

using motion::Ball;
using motion::CoarseMotion;
using motion::MatrixPose;
using motion::Vector3;

#ifndef COARSE_BUDGET
#define COARSE_BUDGET 24
#define COARSE_DEPTH 3
#define COARSE_DEV 0.1
#define COARSE_SMALL 0.12
#endif
constexpr int budget = COARSE_BUDGET;
constexpr int most_halvings = COARSE_DEPTH;
constexpr double deviation_of_side = COARSE_DEV;
constexpr double small = COARSE_SMALL;

/// A stack of pairs of nodes. It refuses pairs when it is full.
class PairStack {
public:
    [[nodiscard]] bool is_empty() const { return count_ == 0; }
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
    CoarseTest(const Body& moving, const Body& fixed, const CoarseMotion& coarse, double margin);

    bool proves_clear() {
        PairStack roots;
        roots.push({0, 0, {}});
        return separates(roots, {{}, placement(0), placement(1)});
    }

private:
    /// Whether all pairs of the stack are proven apart during the part.
    bool separates(PairStack& pairs, const Part& part);
    bool separates_in_halves(PairStack& deferred, const Part& part);
    bool split(const NodePair& pair, const SweptBoxes& boxes, PairStack& pairs);
    [[nodiscard]] BoxSlack slack(const Part& part) const;
    [[nodiscard]] Placement placement(double tau) const;

    std::span<const BvhNode> moving_nodes_;
    std::span<const BvhNode> fixed_nodes_;
    const CoarseMotion& coarse_;
    Ball moving_;
    Ball fixed_;
    double margin_;
    motion::ChordDeviation deviation_;
    double small_side_; ///< a pair of nodes of this size that is not separated ends the test
    int budget_ = budget;
};

Ball enlarged(Ball ball, double margin) {
    ball.radius += margin;
    return ball;
}

CoarseTest::CoarseTest(const Body& moving, const Body& fixed, const CoarseMotion& coarse, double margin)
    : moving_nodes_(moving.bvh().nodes()), fixed_nodes_(fixed.bvh().nodes()), coarse_(coarse),
      moving_(enlarged(ball_around(moving.bvh()), margin)), fixed_(enlarged(ball_around(fixed.bvh()), margin)),
      margin_(margin), deviation_(coarse.path, moving_, fixed_),
      small_side_(small * std::min(longest_side(moving_nodes_[0]), longest_side(fixed_nodes_[0]))) {}

Placement CoarseTest::placement(double tau) const {
    const motion::MatrixPose pose = position_at(coarse_.path, tau);
    const Vector3<double> centre = pose.rotation * motion::vector_in<double>(moving_.centre) +
                                   (pose.translation - motion::vector_in<double>(fixed_.centre));
    Placement placed;
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j)
            placed.rotation(i, j) = pose.rotation.row[i][j];
        placed.offset[i] = centre[i];
    }
    return placed;
}

BoxSlack CoarseTest::slack(const Part& part) const {
    const double distance = std::max(part.start.offset.lpNorm<1>(), part.end.offset.lpNorm<1>());
    const double bodies = moving_.radius + fixed_.radius;
    const double size = coarse_.size + moving_.centre.lpNorm<1>() + fixed_.centre.lpNorm<1>() + bodies;
    const double rounding = coarse_.deviation + motion::coarse_rounding * size +
                            float_rounding(bodies + distance, margin_) + flushed_floats;
    return {deviation_.of_moving(part.range.lower, part.range.upper) + rounding,
            deviation_.of_fixed(part.range.lower, part.range.upper) + rounding, margin_};
}

bool CoarseTest::separates(PairStack& pairs, const Part& part) {
    const BoxSlack widened = slack(part);
    const double deviation = std::max(widened.moving, widened.fixed);
    std::optional<SweptBoxes> boxes;
    PairStack deferred;
    while (!pairs.is_empty()) {
        const NodePair pair = pairs.pop();
        const BvhNode& moving = moving_nodes_[pair.moving];
        const BvhNode& fixed = fixed_nodes_[pair.fixed];
        const double side = std::max(longest_side(moving), longest_side(fixed));
        if (side < small_side_ || (moving.is_leaf() && fixed.is_leaf()))
            return false;
        if (part.halvings < most_halvings && deviation > deviation_of_side * side + 0.3 * margin_) {
            if (!deferred.push(pair))
                return false;
            continue;
        }
        if (!boxes)
            boxes.emplace(part.start, part.end, widened);
        if (!split(pair, *boxes, pairs))
            return false;
    }
    return deferred.is_empty() || separates_in_halves(deferred, part);
}

bool CoarseTest::separates_in_halves(PairStack& deferred, const Part& part) {
    const double middle = part.range.at(0.5);
    const Placement between = placement(middle);
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

/// Pushes the pairs of children that are not separated. False if the budget is used up.
bool CoarseTest::split(const NodePair& pair, const SweptBoxes& boxes, PairStack& pairs) {
    if (--budget_ < 0)
        return false;
    const NodeSplit nodes(pair, moving_nodes_, fixed_nodes_);
    const auto when =
        boxes.overlap_windows(nodes.moving.of(moving_nodes_), nodes.fixed.of(fixed_nodes_), pair.when);
    for (std::uint32_t i = 0; i < nodes.moving.count; ++i)
        for (std::uint32_t j = 0; j < nodes.fixed.count; ++j)
            if (const Window& window = when[2 * i + j]; !window.is_empty())
                if (!pairs.push({nodes.moving.first + i, nodes.fixed.first + j, window}))
                    return false;
    return true;
}

} // namespace

bool are_clearly_apart(const Body& moving, const Body& fixed, const motion::AnyTrajectory& trajectory, double margin) {
    const std::optional<CoarseMotion> coarse = trajectory.coarse();
    return coarse && CoarseTest(moving, fixed, *coarse, margin).proves_clear();
}

} // namespace chasles::culling
