// A body as it is drawn: triangles for the surface, lines where it bends.
#pragma once

#include "chasles/mesh/polyhedron.h"

#include <Eigen/Geometry>
#include <array>
#include <vector>

namespace chasles::view {

/// Single precision about an origin in double, so that a small body far from its frame's origin keeps its shape.
struct DrawnMesh {
    Eigen::Vector3d origin = Eigen::Vector3d::Zero(); ///< middle of the body's box, in the body's frame
    std::vector<std::array<float, 3>> vertices;       ///< those of the body, less the origin
    std::vector<std::array<std::uint32_t, 3>> triangles;
    std::vector<std::array<std::uint32_t, 2>> creases; ///< edges at which the surface ends or bends
};

DrawnMesh drawn_mesh(const Polyhedron& body);

/// Faces that turn by more than this at an edge make it a crease, radians. Half of what the corner of a hexagon turns
/// by: nuts have their edges, and what is round in twelve facets or more looks round.
inline constexpr double least_crease = 0.6;

} // namespace chasles::view
