// The plane of a polygon, how far its corners leave it, and the polygon seen along its normal.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

namespace chasles {

/// Seen so that the polygon turns to the left, with one coordinate left out: the remaining ones are not rounded.
struct PolygonProjection {
    std::vector<Eigen::Vector2d> corners;
    double deviation; ///< greatest distance of a corner from the middle plane along the normal
    double size;      ///< diagonal of the bounding box
    double magnitude; ///< largest coordinate without sign
    bool is_flat;     ///< the area is zero, or smaller than its own rounding; then the rest means nothing
};

[[nodiscard]] PolygonProjection project_polygon(std::span<const Eigen::Vector3d> vertices,
                                                std::span<const std::uint32_t> outline);

/// Whether the outline is convex: it turns to the left or goes straight at each corner, once around in all.
[[nodiscard]] bool is_convex(std::span<const Eigen::Vector2d> outline);

/// The first corner where the outline turns back onto the side it came along, or the number of corners.
[[nodiscard]] std::size_t find_turning_back(std::span<const Eigen::Vector2d> outline);

} // namespace chasles
