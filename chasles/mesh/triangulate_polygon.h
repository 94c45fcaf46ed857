// Cuts a polygon into triangles by ear clipping with exact predicates.
// The result is proven to cover the polygon exactly once.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace chasles {

/// Triangles that turn left and cover the polygon exactly once: positions in `outline`, three for each triangle. Empty
/// if the outline crosses itself or turns right.
///
/// The outline may touch itself, and it may use a side in both directions as a bridge to a hole. It must not turn back
/// onto itself at a corner. If the outline does not touch itself, the result has n - 2 triangles and uses every corner.
[[nodiscard]] std::optional<std::vector<std::uint32_t>> triangulate_polygon(std::span<const Eigen::Vector2d> outline);

} // namespace chasles
