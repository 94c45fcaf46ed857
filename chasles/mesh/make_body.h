// Makes a body of vertices and faces, or refuses them by name.
#pragma once

#include "chasles/mesh/body.h"

namespace chasles {

/// Source of what is refused: Polyhedron::from_polygons.
[[nodiscard]] BodyParts make_body(std::span<const Eigen::Vector3d> vertices,
                                  std::span<const std::span<const std::uint32_t>> faces,
                                  const PolyhedronOptions& options);

} // namespace chasles
