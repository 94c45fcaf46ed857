// Directions that can keep two triangles apart, in double and in multiprecision.
#pragma once

#include "tests/attack/true_motion.h"

#include <algorithm>
#include <array>

namespace chasles::attack {

template <class T>
using Corners = std::array<Eigen::Matrix<T, 3, 1>, 3>;

/// The normals of both triangles, the products of two edges, and the normals of edges within their triangles.
inline constexpr int axis_count = 17;

/// Whether the axis depends on the moving triangle.
inline bool axis_moves(int axis) {
    return axis == 0 || (axis >= 2 && axis < 14);
}

template <class T>
Eigen::Matrix<T, 3, 1> edge_of(const Corners<T>& corners, int edge) {
    return corners[std::size_t((edge + 1) % 3)] - corners[std::size_t(edge)];
}
template <class T>
Eigen::Matrix<T, 3, 1> normal_of(const Corners<T>& corners) {
    return edge_of(corners, 0).cross(edge_of(corners, 1));
}

template <class T>
Eigen::Matrix<T, 3, 1> axis_of(int axis, const Corners<T>& moving, const Corners<T>& fixed) {
    if (axis < 2)
        return normal_of(axis == 0 ? moving : fixed);
    if (axis < 11)
        return edge_of(moving, (axis - 2) / 3).cross(edge_of(fixed, (axis - 2) % 3));
    return axis < 14 ? normal_of(moving).cross(edge_of(moving, axis - 11))
                     : normal_of(fixed).cross(edge_of(fixed, axis - 14));
}

/// How far the moving triangle is ahead of the fixed one along the axis, and the other way round.
template <class T>
std::array<T, 2> gaps_along(const Eigen::Matrix<T, 3, 1>& axis, const Corners<T>& moving, const Corners<T>& fixed) {
    const std::array<T, 3> m{axis.dot(moving[0]), axis.dot(moving[1]), axis.dot(moving[2])};
    const std::array<T, 3> f{axis.dot(fixed[0]), axis.dot(fixed[1]), axis.dot(fixed[2])};
    const auto [least_m, most_m] = std::minmax({m[0], m[1], m[2]});
    const auto [least_f, most_f] = std::minmax({f[0], f[1], f[2]});
    return {least_m - most_f, least_f - most_m};
}

/// Bounds of an axis: its length, and the sum of the products that stay when one factor is left out.
struct AxisSize {
    double length = 0;
    double sensitivity = 0;
};

/// The lengths of a triangle's edges and of its normal, or slightly more.
struct TriangleSize {
    std::array<double, 3> edges{};
    double normal = 0;
};

/// The axis is a product of two or three edges.
inline AxisSize axis_size(int axis, const TriangleSize& moving, const TriangleSize& fixed) {
    const auto of_normal = [](const TriangleSize& t) { return AxisSize{t.normal, t.edges[0] + t.edges[1]}; };
    const auto of_edges = [](double a, double b) { return AxisSize{a * b, a + b}; };
    const auto in_plane = [](const TriangleSize& t, int edge) {
        const auto& e = t.edges;
        const double c = e[std::size_t(edge)];
        return AxisSize{t.normal * c, e[0] * e[1] + (e[0] + e[1]) * c};
    };
    if (axis < 2)
        return of_normal(axis == 0 ? moving : fixed);
    if (axis < 11)
        return of_edges(moving.edges[std::size_t((axis - 2) / 3)], fixed.edges[std::size_t((axis - 2) % 3)]);
    return axis < 14 ? in_plane(moving, axis - 11) : in_plane(fixed, axis - 14);
}

/// Whether the segment passes through the inside of the triangle, with all volumes greater than `slack`.
inline bool passes_through(const WideVector& p, const WideVector& q, const Corners<Wide>& triangle, const Wide& slack) {
    const WideVector normal = normal_of(triangle);
    const Wide above = normal.dot(p - triangle[0]);
    const Wide below = normal.dot(q - triangle[0]);
    if (!((above > slack && below < -slack) || (above < -slack && below > slack)))
        return false;
    int positive = 0;
    int negative = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const Wide volume = (triangle[i] - p).cross(triangle[(i + 1) % 3] - p).dot(q - p);
        positive += volume > slack ? 1 : 0;
        negative += volume < -slack ? 1 : 0;
    }
    return positive == 3 || negative == 3;
}

} // namespace chasles::attack
