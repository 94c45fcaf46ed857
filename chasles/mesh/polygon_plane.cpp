// Computes the normal as a sum of cross products of successive corners (M. Newell) and projects the outline.
// The predicates of the outline are exact.
#include "chasles/mesh/polygon_plane.h"

#include "chasles/mesh/exact_orientation.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

namespace chasles {
namespace {

/// A normal of any length. Corners are taken relative to the first corner, therefore the distance from the origin costs
/// no digits.
Eigen::Vector3d newell_normal(std::span<const Eigen::Vector3d> vertices, std::span<const std::uint32_t> outline) {
    const Eigen::Vector3d& origin = vertices[outline.front()];
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (std::size_t i = 1; i + 1 < outline.size(); ++i)
        sum += (vertices[outline[i]] - origin).cross(vertices[outline[i + 1]] - origin);
    return sum;
}

/// Half the distance of the two planes along the normal that enclose the polygon.
double half_thickness(std::span<const Eigen::Vector3d> vertices, std::span<const std::uint32_t> outline,
                      const Eigen::Vector3d& normal) {
    const Eigen::Vector3d& origin = vertices[outline.front()];
    double least = 0.0;
    double greatest = 0.0;
    for (const std::uint32_t vertex : outline) {
        const double height = normal.dot(vertices[vertex] - origin);
        least = std::min(least, height);
        greatest = std::max(greatest, height);
    }
    return (greatest - least) / 2;
}

/// The corners without the coordinate in which the normal is greatest, oriented to the left.
std::vector<Eigen::Vector2d> projected_along(const Eigen::Vector3d& normal, std::span<const Eigen::Vector3d> vertices,
                                             std::span<const std::uint32_t> outline) {
    Eigen::Index dropped = 0;
    normal.cwiseAbs().maxCoeff(&dropped);
    const bool is_from_above = normal[dropped] > 0.0;
    const Eigen::Index right = (dropped + (is_from_above ? 1 : 2)) % 3;
    const Eigen::Index up = (dropped + (is_from_above ? 2 : 1)) % 3;
    std::vector<Eigen::Vector2d> corners;
    corners.reserve(outline.size());
    for (const std::uint32_t vertex : outline)
        corners.emplace_back(vertices[vertex][right], vertices[vertex][up]);
    return corners;
}

/// Whether b follows a in the order by x, then by y.
bool is_ascending(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y();
}

} // namespace

PolygonProjection project_polygon(std::span<const Eigen::Vector3d> vertices, std::span<const std::uint32_t> outline) {
    const Eigen::Vector3d twice_area = newell_normal(vertices, outline);
    const Eigen::Vector3d normal = twice_area.stableNormalized();
    Eigen::Vector3d lower = vertices[outline.front()];
    Eigen::Vector3d upper = lower;
    for (const std::uint32_t vertex : outline) {
        lower = lower.cwiseMin(vertices[vertex]);
        upper = upper.cwiseMax(vertices[vertex]);
    }
    const double size = (upper - lower).norm();
    // The error of each of n cross products and n additions is a few unit roundoffs of the squared size.
    const double rounding = 8 * std::numeric_limits<double>::epsilon() * static_cast<double>(outline.size());
    return {.corners = projected_along(normal, vertices, outline),
            .deviation = half_thickness(vertices, outline, normal),
            .size = size,
            .magnitude = lower.cwiseAbs().cwiseMax(upper.cwiseAbs()).maxCoeff(),
            .is_flat = twice_area.stableNorm() <= rounding * size * size};
}

bool is_convex(std::span<const Eigen::Vector2d> outline) {
    const std::size_t count = outline.size();
    std::size_t direction_changes = 0; // of the direction along x; an outline with one revolution has two
    for (std::size_t i = 0; i < count; ++i) {
        const Eigen::Vector2d& a = outline[i];
        const Eigen::Vector2d& b = outline[(i + 1) % count];
        const Eigen::Vector2d& c = outline[(i + 2) % count];
        if (orientation(a, b, c) < 0)
            return false;
        direction_changes += is_ascending(a, b) != is_ascending(b, c) ? 1 : 0;
    }
    return direction_changes == 2;
}

std::size_t find_turning_back(std::span<const Eigen::Vector2d> outline) {
    const std::size_t count = outline.size();
    for (std::size_t i = 0; i < count; ++i) {
        const Eigen::Vector2d& a = outline[(i + count - 1) % count];
        const Eigen::Vector2d& b = outline[i];
        const Eigen::Vector2d& c = outline[(i + 1) % count];
        if (a != b && b != c && orientation(a, b, c) == 0 && lies_beyond(a, b, c))
            return i;
    }
    return count;
}

} // namespace chasles
