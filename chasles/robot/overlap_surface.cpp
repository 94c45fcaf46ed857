#include "chasles/robot/overlap_surface.h"

#include "chasles/contact/relative_configuration.h"
#include "chasles/culling/winding.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace chasles::robot {

namespace {

using Eigen::Vector3d;
using Triangle = std::array<Vector3d, 3>;

/// So many points of a surface are tried, those nearest to the middle of both boxes.
constexpr std::size_t most_tries = 24;
/// Surfaces with more faces have enough points without some of their edges.
constexpr std::size_t many_faces = 200;
/// Of all lengths that enter; places are computed in double.
constexpr double rounding_share = 1e-9;

/// The distance of the rim.
double distance_to_rim(const Triangle& triangle, const Vector3d& point) {
    const auto& [a, b, c] = triangle;
    double least = std::numeric_limits<double>::infinity();
    for (const auto& [from, to] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)})
        least = std::min(least, (point - (from == to ? from : contact::foot_on_segment(from, to, point))).norm());
    return least;
}

/// Never more than the distance, but for rounding.
double distance_to(const Triangle& triangle, const Vector3d& point) {
    const auto& [a, b, c] = triangle;
    const Vector3d normal = (b - a).cross(c - a);
    const double rim = distance_to_rim(triangle, point);
    const bool is_beside = normal.squaredNorm() > 0 && normal.cross(b - a).dot(point - a) >= 0 &&
                           normal.cross(c - b).dot(point - b) >= 0 && normal.cross(a - c).dot(point - c) >= 0;
    return is_beside ? std::min(rim, std::abs(normal.dot(point - a)) / normal.norm()) : rim;
}

double squared_distance(const BvhNode& node, const Vector3d& point) {
    double sum = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const double x = point[Eigen::Index(i)];
        const double beside = std::max({double(node.lower[i]) - x, x - double(node.upper[i]), 0.0});
        sum += beside * beside;
    }
    return sum;
}

} // namespace

OverlapSurface::OverlapSurface(const Polyhedron& shape) : body_(&shape.body()) {
    const auto vertices = shape.vertices();
    for (std::size_t f = 0; f < shape.face_count(); ++f) {
        first_triangle_.push_back(triangles_.size());
        for (const auto& [a, b, c] : shape.triangles(f)) {
            triangles_.push_back({vertices[a], vertices[b], vertices[c]});
            points_.emplace_back((vertices[a] + vertices[b] + vertices[c]) / 3);
        }
        const auto face = shape.face(f);
        for (std::size_t i = 0; i < face.size() && shape.face_count() <= many_faces; ++i)
            for (const double share : {0.25, 0.5, 0.75})
                points_.emplace_back(vertices[face[i]] + share * (vertices[face[(i + 1) % face.size()]] - vertices[face[i]]));
    }
    first_triangle_.push_back(triangles_.size());
    for (const Vector3d& vertex : vertices) {
        points_.push_back(vertex);
        box_.extend(vertex);
    }
}

/// Whether the test holds for a triangle among those that may be within a distance of the point.
template <class Test>
bool OverlapSurface::has_triangle(const Vector3d& point, double within, const Test& test) const {
    const Bvh& bvh = body_->bvh();
    const Vector3d seen = point - bvh.centre();
    const double wide = within * (1 + rounding_share) + rounding_share * (bvh.radius() + seen.lpNorm<1>());
    std::array<std::uint32_t, Bvh::max_depth + 1> waiting; // NOLINT(cppcoreguidelines-pro-type-member-init)
    std::size_t count = 0;
    for (waiting[count++] = 0; count > 0;) {
        const BvhNode& node = bvh.nodes()[waiting[--count]];
        if (squared_distance(node, seen) > wide * wide)
            continue;
        if (!node.is_leaf()) {
            waiting[count++] = node.first;
            waiting[count++] = node.first + 1;
            continue;
        }
        for (std::size_t i = first_triangle_[node.first]; i < first_triangle_[node.first + 1]; ++i)
            if (test(triangles_[i]))
                return true;
    }
    return false;
}

/// Near the surface, or in the volume and not near the surface.
bool OverlapSurface::holds(const Vector3d& point, double reach, double slack, double rounding) const {
    const auto is_near = [&](const Triangle& triangle) { return distance_to_rim(triangle, point) < reach - slack; };
    if (reach > slack && has_triangle(point, reach - slack, is_near))
        return true;
    if (!body_->volume().is_solid())
        return false;
    const auto is_in_reach = [&](const Triangle& triangle) { return distance_to(triangle, point) <= slack; };
    if (has_triangle(point, slack, is_in_reach))
        return false;
    const culling::WeightedPoint<double> place{{point.x(), point.y(), point.z()}, 1, rounding};
    return culling::is_inside(*body_, place, point, rounding).value_or(false);
}

namespace {

/// Whether a point of the first surface is in the second body, for any displacement.
bool has_point_in(const OverlapSurface& moving, const OverlapSurface& fixed, const Eigen::Isometry3d& relative,
                  const Displacement& displacement, double rounding) {
    const double reach = moving.body().radius() + fixed.body().radius() + displacement.margin;
    const double slack = displacement.way * (1 + rounding_share) + rounding;
    if (reach <= slack && !fixed.body().volume().is_solid())
        return false;
    const Vector3d wide = Vector3d::Constant(std::max(reach, 0.0));
    const Eigen::AlignedBox3d around(fixed.box().min() - wide, fixed.box().max() + wide);
    std::vector<Vector3d> points;
    Eigen::AlignedBox3d box;
    const Eigen::Matrix3d turn = relative.linear();
    const Vector3d shift = relative.translation();
    for (const Vector3d& point : moving.points()) {
        const Vector3d placed = contact::product(turn, point) + shift;
        box.extend(placed);
        if (around.contains(placed))
            points.push_back(placed);
    }
    const Vector3d middle = box.intersection(around).center();
    const std::size_t tries = std::min(most_tries, points.size());
    std::ranges::partial_sort(points, points.begin() + std::ptrdiff_t(tries), {},
                              [&](const Vector3d& point) { return (point - middle).squaredNorm(); });
    return std::any_of(points.begin(), points.begin() + std::ptrdiff_t(tries),
                       [&](const Vector3d& point) { return fixed.holds(point, reach, slack, rounding); });
}

} // namespace

bool overlap_within(const OverlapSurface& moving, const OverlapSurface& fixed, const Eigen::Isometry3d& relative,
                    const Displacement& displacement) {
    const double size = displacement.size + relative.translation().norm() + moving.box().min().norm() +
                        moving.box().max().norm() + fixed.box().min().norm() + fixed.box().max().norm() +
                        moving.body().radius() + fixed.body().radius() + displacement.margin;
    const double rounding = rounding_share * size;
    return has_point_in(moving, fixed, relative, displacement, rounding) ||
           has_point_in(fixed, moving, relative.inverse(), displacement, rounding);
}

} // namespace chasles::robot
