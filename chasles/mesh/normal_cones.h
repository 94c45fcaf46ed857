// Cones around the normals of the surface below each node of a hierarchy: where a shortest connection to another body
// may lead. Source: D. Johnson, E. Cohen, "Spatialized normal cone hierarchies", 2001;
// docs/derivations/19-normal-cones.md.
#pragma once

#include "chasles/mesh/edge.h"

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace chasles {

class Body;

/// All directions at an angle of at most `angle` from a line, either way along it.
struct NormalCone {
    Eigen::Vector3f axis = Eigen::Vector3f::UnitZ(); ///< unit
    float angle = 0;                                 ///< radians; pi/2: every direction
};

/// A cone that contains two cones.
NormalCone enclosing(const NormalCone& a, const NormalCone& b);

/// The normals of a face.
NormalCone cone_of_face(const Body& body, std::uint32_t face);
/// The directions in which the distance from an edge, or from a vertex, is locally least.
NormalCone cone_of_edge(const Body& body, const Edge& edge);
NormalCone cone_of_vertex(const Body& body, std::uint32_t vertex);

/// One cone a node of the body's hierarchy. A cone contains the normals of the faces below the node, and for the
/// vertices and edges that they own every direction in which the distance from the surface is locally least.
std::vector<NormalCone> normal_cones_of(const Body& body);

} // namespace chasles
