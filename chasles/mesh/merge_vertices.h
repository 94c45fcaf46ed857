// Merges vertices with equal coordinates. Many exporters repeat a vertex for each normal or face.
// Only exactly equal coordinates are merged.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

namespace chasles {

/// For each vertex, the first vertex with equal coordinates. 0 and -0 are equal.
[[nodiscard]] std::vector<std::uint32_t> first_equal_vertices(std::span<const Eigen::Vector3d> vertices);

} // namespace chasles
