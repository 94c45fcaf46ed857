// Vertices with the very same coordinates become one: exporters repeat a vertex for each normal or face.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

namespace chasles {

/// For each vertex the first one with the same coordinates (0 and -0 are the same).
[[nodiscard]] std::vector<std::uint32_t> first_equal_vertices(std::span<const Eigen::Vector3d> vertices);

} // namespace chasles
