// The geometry that the viewer draws for a body: triangles for the surface, lines for the creases.
#pragma once

#include "chasles/mesh/polyhedron.h"

#include <Eigen/Geometry>
#include <array>
#include <vector>

namespace chasles::view {

/// Vertices are in single precision relative to an origin in double precision. A small body that is far from the origin
/// of its frame therefore keeps its shape.
struct DrawnMesh {
    Eigen::Vector3d origin = Eigen::Vector3d::Zero(); ///< centre of the body's bounding box, in the body's frame
    std::vector<std::array<float, 3>> vertices; ///< the body's vertices minus the origin, then those of a round surface
    std::vector<std::array<std::uint32_t, 3>> triangles;
    std::vector<std::array<std::uint32_t, 2>> creases; ///< edges where the surface ends or turns sharply
};

DrawnMesh drawn_mesh(const Polyhedron& body);

/// An edge is a crease if its two faces turn by at least this angle, in radians. The sides of a hexagonal nut turn by
/// pi/3 = 1.05, so their edges are drawn. Twelve facets around a circle turn by pi/6 = 0.52, so their edges are hidden.
inline constexpr double least_crease = 0.6;

} // namespace chasles::view
