// Let n(t) be an axis and r(t) the vector from a corner of the fixed triangle to a corner of the moving one. The gap
// along the axis is the least n . r over the corners. Over a duration h a function leaves its chord by at most F h^2/8,
// where F bounds its second derivative. A point at the distance d from the reference has the speed v <= speed +
// turn_rate d and the acceleration a <= acceleration + (turn_rate^2 + turn_acceleration) d. An axis of edges with the
// product N of their lengths changes, as a product with at most one moving rigid factor, by at most turn_rate N and
// (turn_rate^2 + turn_acceleration) N. With |r| <= D the product rule yields
//     F = (turn_rate^2 + turn_acceleration) N D + 2 turn_rate N v + N a, and F = N a for an axis of the fixed body.
// The chord is least at its ends. So the triangles are apart if both gaps are greater than F h^2 / 8. Rates are bounded
// for each part of time in which they do not jump; the bisection starts from these parts.
#include "tests/attack/touch_search.h"

#include "tests/attack/triangle_axes.h"

#include <cmath>
#include <memory>

namespace chasles::attack {

namespace {

/// Coordinates in double are right within 2^-53 of the scene, and products of edges multiply the error by few units:
/// 128 units are plenty. In multiprecision 2^-200 leaves more than 50 bits for axes that are far away.
constexpr double double_slack = 0x1p-46;
constexpr double wide_slack = 0x1p-200;
constexpr double outward = 1 + 1e-9; // for bounds that are computed in double

using Triangle = std::array<std::uint32_t, 3>;

std::vector<Triangle> triangles_of(const Shape& shape) {
    std::vector<Triangle> result;
    for (const auto& face : shape.faces)
        for (std::size_t i = 1; i + 1 < face.size(); ++i)
            result.push_back({face[0], face[i], face[i + 1]});
    return result;
}

/// Points at one moment, in both precisions.
struct Points {
    double time = 0;
    std::vector<WideVector> wide;
    std::vector<Eigen::Vector3d> rounded;

    template <class T>
    [[nodiscard]] Corners<T> corners(const Triangle& t) const {
        if constexpr (std::is_same_v<T, double>)
            return {rounded[t[0]], rounded[t[1]], rounded[t[2]]};
        else
            return {wide[t[0]], wide[t[1]], wide[t[2]]};
    }
};
using Moment = std::shared_ptr<const Points>;

/// A triangle and the sizes of its rigid shape.
struct Part {
    Triangle corners{};
    TriangleSize size;
    double radius = 0; ///< of a ball around the centroid
    double reach = 0;  ///< greatest distance from the motion's reference
};

Part part_of(const Triangle& t, const std::vector<Eigen::Vector3d>& v, const Eigen::Vector3d& reference) {
    Part part{t, {}};
    const Eigen::Vector3d centre = (v[t[0]] + v[t[1]] + v[t[2]]) / 3;
    for (std::size_t i = 0; i < 3; ++i) {
        part.size.edges[i] = (v[t[(i + 1) % 3]] - v[t[i]]).norm() * outward;
        part.radius = std::max(part.radius, (v[t[i]] - centre).norm() * outward);
        part.reach = std::max(part.reach, (v[t[i]] - reference).norm() * outward);
    }
    part.size.normal = normal_of(Corners<double>{v[t[0]], v[t[1]], v[t[2]]}).norm() * outward;
    const double rounding = double_slack * (part.reach + reference.norm());
    part.size.normal += rounding * (part.size.edges[0] + part.size.edges[1]);
    return part;
}

struct Pair {
    std::uint32_t moving;
    std::uint32_t fixed;
};

class Search {
public:
    Search(const Shape& moving, const Shape& fixed, const TrueMotion& motion, const TouchOptions& options)
        : motion_(motion), options_(options), size_(scene_size(moving, fixed, motion)), shape_(moving),
          least_width_(std::ldexp(1.0, -options.depth)) {
        for (const Triangle& t : triangles_of(moving))
            moving_.push_back(part_of(t, moving.vertices, motion.reference));
        for (const Triangle& t : triangles_of(fixed))
            fixed_.push_back(part_of(t, fixed.vertices, motion.reference));
        for (const Eigen::Vector3d& v : fixed.vertices) {
            still_.wide.push_back(widened(v));
            still_.rounded.push_back(v);
        }
    }

    TrueTouch run() {
        Moment from = at(0);
        std::vector<Pair> pairs;
        for (std::uint32_t i = 0; i < moving_.size(); ++i)
            for (std::uint32_t j = 0; j < fixed_.size(); ++j)
                pairs.push_back({i, j});
        if (any_passes_through(pairs, *from)) {
            found_.lower = 0;
            found_.upper = 0;
            return found_;
        }
        for (const TruePart& part : motion_.parts) {
            rates_ = part.rates;
            const Moment to = at(part.to);
            if (explore(from, to, pairs))
                return found_;
            from = to;
        }
        found_.is_clear = !is_open_;
        return found_;
    }

private:
    [[nodiscard]] Moment at(double time) const {
        const TruePose pose = motion_.at(time);
        auto points = std::make_shared<Points>();
        points->time = time;
        for (const Eigen::Vector3d& v : shape_.vertices) {
            points->wide.push_back(pose.turn * widened(v) + pose.place);
            points->rounded.push_back(narrowed(points->wide.back()));
        }
        return points;
    }

    /// Searches a part of time for the pairs that are not yet proven clear, the earlier half first. True after a proven
    /// touch.
    bool explore(const Moment& from, const Moment& to, const std::vector<Pair>& pairs) {
        if (++found_.parts > options_.budget && found_.parts % 64 == 0)
            least_width_ *= 2;
        std::vector<Pair> left;
        for (const Pair& pair : pairs)
            if (!is_clear(pair, *from, *to))
                left.push_back(pair);
        if (left.empty())
            return false;
        const double width = to->time - from->time;
        if (width <= least_width_)
            return settle(*from, *to, left);
        const Moment middle = at(from->time + width / 2);
        return explore(from, middle, left) || explore(middle, to, left);
    }

    /// A part that is too short to cut. Where neither a touch nor its absence is proven, the next parts may be longer.
    bool settle(const Points& from, const Points& to, const std::vector<Pair>& pairs) {
        if (!is_open_)
            found_.lower = from.time;
        is_open_ = true;
        least_width_ *= 2;
        if (!any_passes_through(pairs, to))
            return false;
        found_.upper = to.time;
        return true;
    }

    [[nodiscard]] bool any_passes_through(const std::vector<Pair>& pairs, const Points& points) const {
        return std::ranges::any_of(pairs, [&](const Pair& pair) { return passes(pair, points); });
    }

    /// Whether an edge of one triangle passes through the other.
    [[nodiscard]] bool passes(const Pair& pair, const Points& points) const {
        const Part& a = moving_[pair.moving];
        const Part& b = fixed_[pair.fixed];
        if (distance_of_centres(a, b, points) > (a.radius + b.radius) * outward + double_slack * size_)
            return false;
        const Wide slack = Wide(wide_slack) * Wide(size_) * Wide(size_) * Wide(size_);
        const auto moving = points.corners<Wide>(a.corners);
        const auto fixed = still_.corners<Wide>(b.corners);
        for (std::size_t i = 0; i < 3; ++i)
            if (passes_through(moving[i], moving[(i + 1) % 3], fixed, slack) ||
                passes_through(fixed[i], fixed[(i + 1) % 3], moving, slack))
                return true;
        return false;
    }

    [[nodiscard]] double distance_of_centres(const Part& a, const Part& b, const Points& points) const {
        const auto m = points.corners<double>(a.corners);
        const auto f = still_.corners<double>(b.corners);
        return ((m[0] + m[1] + m[2]) - (f[0] + f[1] + f[2])).norm() / 3;
    }

    /// The bound F of the gap's second derivative.
    [[nodiscard]] double bend(int axis, double length, double distance, double reach) const {
        const double turn = rates_.turn_rate * rates_.turn_rate + rates_.turn_acceleration;
        const double still = rates_.acceleration + turn * reach;
        const double speed = rates_.speed + rates_.turn_rate * reach;
        return length * (axis_moves(axis) ? turn * distance + 2 * rates_.turn_rate * speed + still : still) * outward;
    }

    /// Whether the triangles are proven apart from one moment to another.
    [[nodiscard]] bool is_clear(const Pair& pair, const Points& from, const Points& to) const {
        const Part& a = moving_[pair.moving];
        const Part& b = fixed_[pair.fixed];
        const double width = to.time - from.time;
        const double path = (rates_.speed + rates_.turn_rate * a.reach) * width * outward;
        const double both = (distance_of_centres(a, b, from) + distance_of_centres(a, b, to)) * outward;
        const double radii = (a.radius + b.radius + options_.margin) * outward;
        if (!options_.wide_only && (both - path) / 2 > radii + 1e-8 * both + double_slack * size_)
            return true;
        const double distance = (both + path) / 2 + radii;
        const auto fixed = still_.corners<double>(b.corners);
        const std::array<Corners<double>, 2> moving{from.corners<double>(a.corners), to.corners<double>(a.corners)};
        for (int axis = 0; axis < axis_count; ++axis) {
            const AxisSize size = axis_size(axis, a.size, b.size);
            const double needed = options_.margin * size.length * outward +
                                  bend(axis, size.length, distance, a.reach) * width * width / 8;
            const double error = size_ * (size.sensitivity * distance + size.length);
            const auto first = gaps_along(axis_of(axis, moving[0], fixed), moving[0], fixed);
            const auto last = gaps_along(axis_of(axis, moving[1], fixed), moving[1], fixed);
            for (const std::size_t side : {0u, 1u}) {
                const double gap = std::min(first[side], last[side]);
                if (gap <= needed - double_slack * error)
                    continue;
                if ((!options_.wide_only && gap > needed + double_slack * error) ||
                    is_clear_in_wide({axis, side, needed + wide_slack * error}, pair, from, to))
                    return true;
            }
        }
        return false;
    }

    struct Claim {
        int axis;
        std::size_t side;
        double gap;
    };

    /// Whether both gaps are greater than claimed.
    [[nodiscard]] bool is_clear_in_wide(const Claim& claim, const Pair& pair, const Points& from,
                                        const Points& to) const {
        const auto fixed = still_.corners<Wide>(fixed_[pair.fixed].corners);
        return std::ranges::all_of(std::array{&from, &to}, [&](const Points* points) {
            const auto moving = points->corners<Wide>(moving_[pair.moving].corners);
            return gaps_along(axis_of(claim.axis, moving, fixed), moving, fixed)[claim.side] > claim.gap;
        });
    }

    const TrueMotion& motion_;
    TrueRates rates_; ///< of the part of time that is being searched
    TouchOptions options_;
    double size_;
    const Shape& shape_;
    double least_width_;
    std::vector<Part> moving_;
    std::vector<Part> fixed_;
    Points still_; ///< the fixed body
    bool is_open_ = false;
    TrueTouch found_;
};

} // namespace

TrueTouch first_touch(const Shape& moving, const Shape& fixed, const TrueMotion& motion, const TouchOptions& options) {
    return Search(moving, fixed, motion, options).run();
}

double scene_size(const Shape& moving, const Shape& fixed, const TrueMotion& motion) {
    double size = 0;
    for (const Eigen::Vector3d& v : fixed.vertices)
        size = std::max(size, v.norm());
    for (const TruePart& part : motion.parts) {
        const Eigen::Isometry3d pose = narrowed(motion.at(part.middle()));
        for (const Eigen::Vector3d& v : moving.vertices) {
            const double speed = part.rates.speed + part.rates.turn_rate * (v - motion.reference).norm();
            size = std::max({size, v.norm(), (pose * v).norm() + speed * (part.to - part.from)});
        }
    }
    return size;
}

} // namespace chasles::attack
