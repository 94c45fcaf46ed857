// Cuts a polygon into triangles by its ears, with exact decisions, and proves that they cover it once.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace chasles {

/// Positions within `outline`, three by three, of triangles that turn to the left and cover the polygon exactly once;
/// nothing if the outline crosses itself or turns to the right.
///
/// The outline may touch itself and may use a side to and fro, as the bridge to a hole does, but must turn back onto
/// itself at no corner. Where it touches itself nowhere every corner is used: n - 2 triangles.
[[nodiscard]] std::optional<std::vector<std::uint32_t>> triangulate_polygon(std::span<const Eigen::Vector2d> outline);

} // namespace chasles
