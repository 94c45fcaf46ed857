#include "chasles/memory/orbit_pairs.h"

#include "chasles/algebra/arc_tangent.h"
#include "chasles/motion/screw_path.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace chasles::memory {

namespace {

using algebra::Vector3;
using std::numbers::pi;

/// Of coordinates and of their differences, as a share of the lengths that enter.
constexpr double rounding = 0x1p-44;
/// A radius whose square underflows is below 2^-510.
constexpr double underflow = 0x1p-500;

/// The angle between two points at least `nearest` from the axis is below this share of distance over radius.
constexpr double turn_of_distance = 1.6;

/// Where the trees' moving body stands when it is turned about the axis and raised along it.
motion::MatrixPose placed(const motion::Orbit& trees, double turn, double height) {
    const motion::AxisFrame& fixed = trees.fixed;
    const auto [sine, cosine] = algebra::sine_cosine(turn);
    const Vector3<double> across = scale(fixed.across, cosine) + scale(fixed.beside, sine);
    const Vector3<double> beside = scale(fixed.beside, cosine) - scale(fixed.across, sine);
    const algebra::Matrix3<double> out = algebra::Matrix3<double>{{across, beside, fixed.along}}.transposed();
    const motion::AxisFrame& moving = trees.moving;
    const algebra::Matrix3<double> rotation =
        out * algebra::Matrix3<double>{{moving.across, moving.beside, moving.along}};
    return {rotation, fixed.origin + scale(fixed.along, height) - rotation * moving.origin};
}

/// How far any place of the moving body is from the point of the axis, at most.
double extent(const motion::Orbit& orbit, const motion::Ball& moving) {
    const Vector3<double> centre = orbit.start(motion::vector_in<double>(moving.centre));
    return length(centre - orbit.fixed.origin) + moving.radius + std::abs(orbit.pitch) * orbit.turn;
}

/// All lengths that enter the coordinates.
double lengths(const motion::Orbit& orbit, const motion::Ball& moving) {
    return extent(orbit, moving) + length(orbit.fixed.origin) + length(orbit.moving.origin) + moving.centre.norm() +
           2 * pi * std::abs(orbit.pitch);
}

double size(const OrbitNode& node) {
    return node.upper.radius - node.lower.radius + node.upper.rise - node.lower.rise +
           node.upper.radius * (node.last_turn - node.first_turn);
}

bool is_against(const motion::Orbit& orbit, const motion::Orbit& of_trees) {
    return dot(orbit.fixed.along, of_trees.fixed.along) < 0;
}

/// How far two motions that start alike drift apart: a bound of the difference of their speeds by radian, times the
/// turn.
double drift(const motion::Orbit& orbit, const motion::Orbit& of_trees, const motion::Ball& moving) {
    const Vector3<double> along = scale(orbit.fixed.along, is_against(orbit, of_trees) ? -1.0 : 1.0);
    const Vector3<double> between = orbit.fixed.origin - of_trees.fixed.origin;
    return orbit.turn * (length(along - of_trees.fixed.along) * (extent(orbit, moving) + std::abs(of_trees.pitch)) +
                         length(cross(of_trees.fixed.along, between)) + std::abs(orbit.pitch - of_trees.pitch));
}

class OrbitTraversal {
public:
    OrbitTraversal(const OrbitTree& moving, const OrbitTree& fixed, const OrbitWay& way, std::size_t most_tests)
        : moving_(moving), fixed_(fixed), way_(way), most_tests_(most_tests) {}

    bool run();
    [[nodiscard]] std::vector<culling::NodePair> take() { return std::move(found_); }
    [[nodiscard]] std::uint64_t tests() const { return tests_; }

private:
    struct Pair {
        std::uint32_t moving;
        std::uint32_t fixed;
    };
    /// What is added to the turns and rises of the moving tree. One round is a whole turn of the fixed tree.
    struct Round {
        double first_turn;
        double last_turn;
        double rise;
    };

    struct View {
        const OrbitNode& node;
        std::span<const OrbitPoint> corners;
    };

    bool run_round(int round);
    void visit(const Pair& pair);
    [[nodiscard]] bool are_apart(const OrbitNode& a, const OrbitNode& b) const;
    /// Two intervals with a gap of more than `reach` between them.
    static bool are_apart(double first_a, double last_a, double first_b, double last_b, double reach) {
        return first_a > last_b + reach || first_b > last_a + reach;
    }
    [[nodiscard]] bool have_side_between(const View& own, const View& other, double rise, double stretch) const;
    [[nodiscard]] culling::Window window(const OrbitNode& a, const OrbitNode& b) const;

    const OrbitTree& moving_;
    const OrbitTree& fixed_;
    const OrbitWay& way_;
    std::size_t most_tests_;
    Round round_{};
    std::vector<Pair> stack_;
    std::vector<culling::NodePair> found_;
    std::uint64_t tests_ = 0;
};

/// How far apart points within `reach` may be around the axis, if they are at least `nearest` from it; infinite close
/// to the axis.
double turn_within(double reach, double nearest) {
    return nearest > reach ? turn_of_distance * reach / nearest : std::numeric_limits<double>::infinity();
}

/// The turns of the motion at which the nodes may be at the same turn, as shares of the whole.
culling::Window OrbitTraversal::window(const OrbitNode& a, const OrbitNode& b) const {
    const double slack = turn_within(way_.reach, std::max(a.nearest, b.nearest) - way_.reach) + 8 * pi * rounding;
    const double start = way_.turn > 0 ? round_.first_turn : round_.last_turn;
    double first = (b.first_turn - a.last_turn - slack - start) / way_.turn;
    double last = (b.last_turn - a.first_turn + slack - start) / way_.turn;
    if (way_.turn < 0)
        std::swap(first, last);
    constexpr double float_slack = 0x1p-20;
    return {float(std::clamp(first - way_.unevenness - float_slack, 0.0, 2.0)),
            float(std::clamp(last + way_.unevenness + float_slack, -1.0, 1.0))};
}

/// Whether a side of the hull of `own` has all of `other`, which is raised, beyond it.
bool OrbitTraversal::have_side_between(const View& own, const View& other, double rise, double stretch) const {
    const double around = own.node.around + other.node.around;
    for (std::size_t i = 0; i < own.corners.size() && own.corners.size() > 1; ++i) {
        const OrbitPoint& from = own.corners[i];
        const OrbitPoint& to = own.corners[i + 1 < own.corners.size() ? i + 1 : 0];
        const OrbitPoint out{to.rise - from.rise, from.radius - to.radius};
        double least = std::numeric_limits<double>::infinity();
        for (const OrbitPoint& corner : other.corners)
            least = std::min(least,
                             out.radius * (corner.radius - from.radius) + out.rise * (corner.rise + rise - from.rise));
        const double across = std::abs(out.radius);
        const double along = std::abs(out.rise);
        const double inward = out.radius < 0 ? own.node.inward : other.node.inward;
        if (least > across * (inward + around + way_.reach) +
                        along * (own.node.rising + other.node.rising + around + stretch * way_.reach))
            return true;
    }
    return false;
}

bool OrbitTraversal::are_apart(const OrbitNode& a, const OrbitNode& b) const {
    if (window(a, b).is_empty() ||
        are_apart(a.lower.radius, a.upper.radius, b.lower.radius, b.upper.radius, way_.reach))
        return true;
    const double nearest = std::max(a.nearest, b.nearest) - way_.reach;
    if (!(nearest > 0))
        return false;
    const double steepness = way_.pitch / nearest;
    const double stretch = std::sqrt(1 + steepness * steepness); // of rises, within the reach
    if (are_apart(a.lower.rise + round_.rise, a.upper.rise + round_.rise, b.lower.rise, b.upper.rise,
                  stretch * way_.reach))
        return true;
    const View of_a{a, moving_.corners(a)};
    const View of_b{b, fixed_.corners(b)};
    return have_side_between(of_a, of_b, -round_.rise, stretch) || have_side_between(of_b, of_a, round_.rise, stretch);
}

void OrbitTraversal::visit(const Pair& pair) {
    const OrbitNode& a = moving_.nodes()[pair.moving];
    const OrbitNode& b = fixed_.nodes()[pair.fixed];
    ++tests_;
    if (are_apart(a, b))
        return;
    if (a.is_leaf && b.is_leaf) {
        found_.push_back({a.first, b.first, window(a, b)});
        return;
    }
    const bool splits_moving = b.is_leaf || (!a.is_leaf && size(a) >= size(b));
    for (const std::uint32_t child : {0U, 1U})
        stack_.push_back(splits_moving ? Pair{a.first + child, pair.fixed} : Pair{pair.moving, b.first + child});
}

bool OrbitTraversal::run_round(int round) {
    const double around = 2 * pi * round;
    const double last = way_.first_turn + way_.turn;
    round_ = {std::min(way_.first_turn, last) - around, std::max(way_.first_turn, last) - around,
              way_.rise + around * way_.pitch};
    for (stack_.push_back({0, 0}); !stack_.empty();) {
        const Pair pair = stack_.back();
        stack_.pop_back();
        visit(pair);
        if (tests_ > most_tests_)
            return false;
    }
    return true;
}

bool OrbitTraversal::run() {
    const OrbitNode& a = moving_.nodes()[0];
    const OrbitNode& b = fixed_.nodes()[0];
    const double last = way_.first_turn + way_.turn;
    const double least = a.first_turn + std::min(way_.first_turn, last) - b.last_turn;
    const double most = a.last_turn + std::max(way_.first_turn, last) - b.first_turn;
    for (int round = int(std::floor(least / (2 * pi))); round <= int(std::ceil(most / (2 * pi))); ++round)
        if (!run_round(round))
            return false;
    return true;
}

} // namespace

OrbitWay way_along(const motion::Orbit& orbit, const motion::Orbit& of_trees, const motion::Ball& moving,
                   double margin) {
    const motion::AxisFrame& fixed = of_trees.fixed;
    const Vector3<double> across = orbit.start.rotation * of_trees.moving.across;
    const double height = dot(orbit.start(of_trees.moving.origin) - fixed.origin, fixed.along);
    OrbitWay way;
    way.first_turn = algebra::arc_tangent(dot(across, fixed.beside), dot(across, fixed.across));
    way.turn = is_against(orbit, of_trees) ? -orbit.turn : orbit.turn;
    way.pitch = of_trees.pitch;
    way.rise = height - way.pitch * way.first_turn;
    way.unevenness = orbit.unevenness;
    const double apart = distance(orbit.start, placed(of_trees, way.first_turn, height),
                                  motion::vector_in<double>(moving.centre), moving.radius);
    way.reach = margin + orbit.deviation + apart + drift(orbit, of_trees, moving) +
                rounding * (lengths(orbit, moving) + lengths(of_trees, moving) + std::abs(height)) + underflow;
    return way;
}

std::optional<std::vector<culling::NodePair>> orbit_pairs(const OrbitTree& moving, const OrbitTree& fixed,
                                                          const OrbitWay& way, std::size_t most_tests,
                                                          std::uint64_t& tests) {
    OrbitTraversal traversal(moving, fixed, way, most_tests);
    const bool is_done = traversal.run();
    tests += traversal.tests();
    return is_done ? std::optional(traversal.take()) : std::nullopt;
}

} // namespace chasles::memory
