// The plane of a polygon, the deviation of its corners from the plane, and its projection to two coordinates.
// The projection does not round.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

namespace chasles {

/// A share of the size or of the greatest coordinate: six digits in a file move a corner by up to 5e-6 of its
/// coordinate (docs/decisions/0010-polygon-planarity.md).
inline constexpr double planar_within = 1e-5;

/// A polygon without one coordinate, oriented to the left. The remaining coordinates are not rounded. Lengths are in
/// the length unit.
struct PolygonProjection {
    std::vector<Eigen::Vector2d> corners;
    double deviation; ///< greatest distance of a corner from the middle plane
    double size;      ///< diagonal of the bounding box
    double magnitude; ///< greatest magnitude of a coordinate
    bool is_flat;     ///< the area is zero or below its rounding error; the other members are then meaningless
};

[[nodiscard]] PolygonProjection project_polygon(std::span<const Eigen::Vector3d> vertices,
                                                std::span<const std::uint32_t> outline);

/// Whether the outline is convex: it turns left or is straight at each corner, with one revolution in total.
[[nodiscard]] bool is_convex(std::span<const Eigen::Vector2d> outline);

/// The first corner at which the outline turns back onto the previous side, or the number of corners if there is none.
[[nodiscard]] std::size_t find_turning_back(std::span<const Eigen::Vector2d> outline);

} // namespace chasles
