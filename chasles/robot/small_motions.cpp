#include "chasles/robot/small_motions.h"

#include "chasles/contact/relative_configuration.h"
#include "chasles/contact/segment_shares.h"
#include "chasles/culling/nested_boxes.h"
#include "chasles/robot/pair_walk.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace chasles::robot {

namespace {

using Eigen::Vector3d;

/// Of all lengths that enter; places are computed in double.
constexpr double rounding_share = 1e-9;
/// So many points are tried, those nearest to the middle of both boxes.
constexpr std::size_t most_tries = 24;

double rounding_of(const PairAtRest& pair) {
    return rounding_share * (pair.size + pair.relative.translation().lpNorm<1>() + pair.moving.size() +
                             pair.fixed.size() + pair.margin) +
           pair.moving.warp() + pair.fixed.warp();
}

/// How near the polyhedra may be.
double reach_of(const PairAtRest& pair) {
    return pair.moving.body().radius() + pair.fixed.body().radius() + pair.margin;
}

/// A vector from a point of the second segment to one of the first: the shortest one, but for rounding.
Vector3d between_segments(const Vector3d& p, const Vector3d& along_p, const Vector3d& q, const Vector3d& along_q) {
    const Vector3d apart = p - q;
    const auto [s, t] =
        contact::nearest_shares(apart, along_p, along_q, [](const Vector3d& a, const Vector3d& b) { return a.dot(b); });
    return apart + s * along_p - t * along_q;
}

/// From the second triangle to the first one, near the shortest way. Any vector will do: what counts is the gap along
/// it.
Vector3d between_triangles(const Triangle& first, const Triangle& second) {
    Vector3d least = first[0] - second[0];
    double square = least.squaredNorm();
    const auto take = [&](const Vector3d& way) {
        if (const double other = way.squaredNorm(); other < square) {
            least = way;
            square = other;
        }
    };
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t k = 0; k < 3; ++k)
            take(between_segments(first[i], first[(i + 1) % 3] - first[i], second[k], second[(k + 1) % 3] - second[k]));
    for (std::size_t i = 0; i < 3; ++i) {
        take(first[i] - nearest_on(second, first[i]));
        take(nearest_on(first, second[i]) - second[i]);
    }
    return least;
}

/// Looks for two faces that may come within reach. Two parts stay apart if their gap along some direction is more than
/// the points of one of them may move along it.
class ApartTest {
public:
    explicit ApartTest(const PairAtRest& pair)
        : pair_(pair), motion_(pair.motion), walk_(pair), slack_(reach_of(pair) + rounding_of(pair)) {}

    std::optional<NearFaces> run(const std::optional<NearFaces>& first) {
        if (first && !are_apart(*first))
            return first;
        return walk_.find(
            [&](const PairWalk::Box& moving, const PairWalk::Box& fixed) { return !are_apart(moving, fixed); },
            [&](const NearFaces& faces) { return !are_apart(faces); });
    }

private:
    using Box = PairWalk::Box;
    /// Whether points within both radii may close a gap along a direction.
    [[nodiscard]] bool is_enough(double gap, const Vector3d& direction, const Box& moving, const Box& fixed) const {
        return gap > motion_.way_along(direction, moving.centre, moving.half.norm()) + motion_.rest_of_moving ||
               gap > motion_.way_along(direction, fixed.centre, fixed.half.norm()) + motion_.rest_of_fixed;
    }
    /// Of boxes in the fixed frame; the sides of the moving one are those of the moving frame. Along the shortest way
    /// between boxes aligned with the fixed frame, and along the last direction that has separated faces.
    [[nodiscard]] bool are_apart(const Box& moving, const Box& fixed) const {
        const Vector3d apart = moving.centre - fixed.centre;
        const Vector3d beside = walk_.beside(moving, fixed);
        const double distance = beside.norm(), gap = distance - slack_;
        if (gap > 0 && (gap > std::min(motion_.way_of_moving, motion_.way_of_fixed) ||
                        is_enough(gap, beside.cwiseProduct(apart.cwiseSign()) / distance, moving, fixed)))
            return true;
        const double along = last_.dot(apart) -
                             (pair_.relative.linear().transpose() * last_).cwiseAbs().dot(moving.half) -
                             last_.cwiseAbs().dot(fixed.half) - slack_;
        return along > 0 && is_enough(along, last_, moving, fixed);
    }
    [[nodiscard]] bool are_apart(const NearFaces& faces) {
        for (const Triangle& own : pair_.moving.triangles(faces.moving)) {
            const Triangle moving = walk_.placed(own);
            for (const Triangle& fixed : pair_.fixed.triangles(faces.fixed))
                if (!are_apart_along(last_, moving, fixed) && !are_apart(moving, fixed))
                    return false;
        }
        return true;
    }
    [[nodiscard]] bool are_apart(const Triangle& moving, const Triangle& fixed) {
        const Vector3d way = between_triangles(moving, fixed);
        const double length = way.norm();
        if (!(length > slack_) || !are_apart_along(way / length, moving, fixed))
            return false;
        last_ = way / length;
        return true;
    }
    [[nodiscard]] bool are_apart_along(const Vector3d& normal, const Triangle& moving, const Triangle& fixed) const {
        const double least = std::min({normal.dot(moving[0]), normal.dot(moving[1]), normal.dot(moving[2])});
        const double greatest = std::max({normal.dot(fixed[0]), normal.dot(fixed[1]), normal.dot(fixed[2])});
        const double gap = (least - greatest - slack_) * (1 - rounding_share);
        if (gap <= 0)
            return false;
        const auto is_more = [&](const Triangle& triangle, double rest) {
            return std::ranges::all_of(
                triangle, [&](const Vector3d& corner) { return gap > motion_.way_along(normal, corner) + rest; });
        };
        return is_more(moving, motion_.rest_of_moving) || is_more(fixed, motion_.rest_of_fixed);
    }

    const PairAtRest& pair_;
    const SmallMotion& motion_;
    PairWalk walk_;
    double slack_;
    Vector3d last_ = Vector3d::UnitX();
};

/// At the configuration itself. Surfaces that stay apart keep it so.
bool may_be_nested(const PairAtRest& pair) {
    if (!pair.moving.is_solid() && !pair.fixed.is_solid())
        return false;
    const Bvh &moving = pair.moving.body().bvh(), &fixed = pair.fixed.body().bvh();
    culling::Placement place;
    place.rotation = pair.relative.linear();
    place.offset =
        contact::product(pair.relative.linear(), moving.centre()) + pair.relative.translation() - fixed.centre();
    return culling::may_be_nested({pair.moving.body(), pair.fixed.body(), place, rounding_of(pair)});
}

} // namespace

std::optional<NearFaces> near_faces(const PairAtRest& pair, const std::optional<NearFaces>& first) {
    if (auto near = ApartTest(pair).run(first))
        return near;
    return may_be_nested(pair) ? std::optional(NearFaces{}) : std::nullopt;
}

namespace {

/// Tests of points of one body in the other one.
class TouchTest {
public:
    TouchTest(const PairAtRest& pair, bool of_moving)
        : motion_(pair.motion), inner_(of_moving ? pair.moving : pair.fixed),
          outer_(of_moving ? pair.fixed : pair.moving), to_outer_(of_moving ? pair.relative : pair.relative.inverse()),
          to_fixed_(of_moving ? Eigen::Isometry3d::Identity() : pair.relative), reach_(reach_of(pair)),
          rounding_(rounding_of(pair)), rest_of_inner_(of_moving ? motion_.rest_of_moving : motion_.rest_of_fixed),
          rest_of_outer_(of_moving ? motion_.rest_of_fixed : motion_.rest_of_moving) {}

    /// Whether an inner point of the first body is in the second one: the point of the second one that is there stays
    /// in the first one.
    [[nodiscard]] bool has_inner_point() const {
        if (!outer_.is_solid())
            return false;
        std::size_t tries = 0;
        for (const auto& [place, depth] : inner_.inner_points()) {
            if (depth <= rest_of_outer_ + rounding_ || tries == most_tries)
                return false;
            const Vector3d point = moved(to_outer_, place);
            if (outer_.box().contains(point) &&
                depth > (motion_.way(in_fixed(point)) + rest_of_outer_) * (1 + rounding_share) + rounding_) {
                ++tries;
                if (outer_.contains(point, rounding_))
                    return true;
            }
        }
        return false;
    }

    /// Whether a point of the first surface stays in the second body, or within reach of it.
    [[nodiscard]] bool has_point() const {
        if (reach_ <= 0 && !outer_.is_solid())
            return false;
        const Vector3d wide = Vector3d::Constant(std::max(reach_, 0.0));
        const Eigen::AlignedBox3d around(outer_.box().min() - wide, outer_.box().max() + wide);
        const Eigen::AlignedBox3d seen = box_around(around, to_outer_.inverse()); // from the inner body
        std::vector<Vector3d> points;
        for (const Vector3d& point : inner_.points())
            if (seen.contains(point))
                if (const Vector3d place = moved(to_outer_, point); around.contains(place))
                    points.push_back(place);
        const Vector3d middle = box_around(inner_.box(), to_outer_).intersection(around).center();
        const std::size_t tries = std::min(most_tries, points.size());
        std::ranges::partial_sort(points, points.begin() + std::ptrdiff_t(tries), {},
                                  [&](const Vector3d& point) { return (point - middle).squaredNorm(); });
        return std::any_of(points.begin(), points.begin() + std::ptrdiff_t(tries),
                           [&](const Vector3d& point) { return stays_within_reach(point) || stays_inside(point); });
    }

private:
    static Vector3d moved(const Eigen::Isometry3d& pose, const Vector3d& point) {
        return contact::product(pose.linear(), point) + pose.translation();
    }
    static Eigen::AlignedBox3d box_around(const Eigen::AlignedBox3d& box, const Eigen::Isometry3d& pose) {
        const Vector3d centre = moved(pose, box.center());
        const Vector3d half = pose.linear().cwiseAbs() * (0.5 * box.sizes());
        return {centre - half, centre + half};
    }
    [[nodiscard]] Vector3d in_fixed(const Vector3d& in_outer) const { return moved(to_fixed_, in_outer); }
    [[nodiscard]] double way(const Vector3d& in_outer) const {
        return (motion_.way(in_fixed(in_outer)) + rest_of_inner_) * (1 + rounding_share) + rounding_;
    }
    [[nodiscard]] bool stays_within_reach(const Vector3d& point) const {
        const double within = reach_ - way(point);
        return within > 0 && outer_.has_triangle(point, within, [&](const Triangle& triangle) {
            return (nearest_on(triangle, point) - point).norm() < within;
        });
    }
    /// No triangle of the surface comes to the point: each stays on one side of a plane through it.
    [[nodiscard]] bool stays_inside(const Vector3d& point) const {
        const auto may_come = [&](const Triangle& triangle) {
            const Vector3d apart = nearest_on(triangle, point) - point;
            const double length = apart.norm();
            if (!(length > 0))
                return true;
            const Vector3d normal = apart / length;
            double gap = std::numeric_limits<double>::infinity();
            for (const Vector3d& corner : triangle)
                gap = std::min(gap, normal.dot(corner - point));
            const double along =
                motion_.way_along(contact::product(to_fixed_.linear(), normal), in_fixed(point)) + rest_of_inner_;
            return gap <= along * (1 + rounding_share) + rounding_;
        };
        return outer_.is_solid() && !outer_.has_triangle(point, way(point), may_come) &&
               outer_.contains(point, rounding_);
    }

    const SmallMotion& motion_;
    const OverlapSurface &inner_, &outer_;
    Eigen::Isometry3d to_outer_; ///< from the frame of the inner body to that of the outer one
    Eigen::Isometry3d to_fixed_; ///< from the frame of the outer body
    double reach_;
    double rounding_;
    double rest_of_inner_, rest_of_outer_;
};

/// An edge that passes through a triangle, and stays so: its ends stay on both sides of the plane of the triangle, and
/// on the inner side of the planes through the sides of the triangle and along the edge.
class CrossingTest {
public:
    explicit CrossingTest(const PairAtRest& pair)
        : pair_(pair), motion_(pair.motion), walk_(pair), rounding_(rounding_of(pair)) {}

    [[nodiscard]] bool run() {
        std::size_t tries = 0;
        bool is_found = false;
        walk_.find([&](const PairWalk::Box& moving,
                       const PairWalk::Box& fixed) { return walk_.beside(moving, fixed).norm() <= rounding_; },
                   [&](const NearFaces& faces) {
                       is_found = pass_through_each_other(faces);
                       return is_found || ++tries == most_tries;
                   });
        return is_found;
    }

private:
    [[nodiscard]] bool pass_through_each_other(const NearFaces& faces) const {
        for (const Triangle& own : pair_.moving.triangles(faces.moving)) {
            const Triangle moving = walk_.placed(own);
            for (const Triangle& fixed : pair_.fixed.triangles(faces.fixed))
                if (passes_through(moving, fixed, motion_.rest_of_moving) ||
                    passes_through(fixed, moving, motion_.rest_of_fixed))
                    return true;
        }
        return false;
    }
    /// `rest`: of the points of the first one, as seen from the second one.
    [[nodiscard]] bool passes_through(const Triangle& edges, const Triangle& triangle, double rest) const {
        const auto& [a, b, c] = triangle;
        const Vector3d normal = (b - a).cross(c - a);
        const double longest = std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
        if (!(normal.norm() > narrow * rounding_ * longest))
            return false;
        for (std::size_t i = 0; i < 3; ++i) {
            const Vector3d &from = edges[i], &to = edges[(i + 1) % 3];
            const double sign = normal.dot(from - a) >= 0 ? 1 : -1;
            if (stays_before(from, {a, b - a, sign * normal}, rest) &&
                stays_before(to, {a, c - a, -sign * normal}, rest) && stays_within(from, to, triangle, rest))
                return true;
        }
        return false;
    }
    [[nodiscard]] bool stays_within(const Vector3d& from, const Vector3d& to, const Triangle& triangle,
                                    double rest) const {
        for (std::size_t i = 0; i < 3; ++i) {
            const Vector3d &a = triangle[i], &b = triangle[(i + 1) % 3], &c = triangle[(i + 2) % 3];
            const Vector3d across = (b - a).cross(to - from);
            const Plane plane{a, b - a, across.dot(c - a) >= 0 ? across : Vector3d(-across)};
            if (!stays_before(from, plane, rest) || !stays_before(to, plane, rest))
                return false;
        }
        return true;
    }
    struct Plane {
        Vector3d point;
        Vector3d along; ///< a side of the triangle
        Vector3d normal;
    };
    /// Whether a point stays on that side of a plane to which its normal points.
    [[nodiscard]] bool stays_before(const Vector3d& point, const Plane& plane, double rest) const {
        const double length = plane.normal.norm();
        const Vector3d unit = plane.normal / length;
        return length > 0 && std::abs(unit.dot(plane.along)) <= rounding_ / (narrow * 100) &&
               unit.dot(point - plane.point) >
                   (motion_.way_along(unit, point) + rest) * (1 + rounding_share) + rounding_;
    }

    /// Triangles that are narrower than so many roundings prove nothing.
    static constexpr double narrow = 1e4;

    const PairAtRest& pair_;
    const SmallMotion& motion_;
    PairWalk walk_;
    double rounding_;
};

} // namespace

bool stay_in_touch(const PairAtRest& pair) {
    const TouchTest moving(pair, true), fixed(pair, false);
    return moving.has_inner_point() || fixed.has_inner_point() || moving.has_point() || fixed.has_point() ||
           CrossingTest(pair).run();
}

} // namespace chasles::robot
