// Makes a body from vertices and faces.
// Invalid input throws InvalidInput with the number of the face or vertex.
#pragma once

#include "chasles/mesh/body.h"

namespace chasles {

/// `Polyhedron::from_polygons` lists the refused input.
[[nodiscard]] BodyParts make_body(std::span<const Eigen::Vector3d> vertices,
                                  std::span<const std::span<const std::uint32_t>> faces,
                                  const PolyhedronOptions& options);

/// The same body with another radius, at least 0. Throws InvalidInput if the body has no area and no radius.
[[nodiscard]] BodyParts with_radius(BodyParts parts, double radius);

} // namespace chasles
