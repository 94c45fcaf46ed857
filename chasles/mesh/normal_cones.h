// Cones around the normals of the surface below each node of a hierarchy: where a shortest connection to another body
// may lead. Source: D. Johnson, E. Cohen, "Spatialized normal cone hierarchies", 2001;
// docs/derivations/19-normal-cones.md.
#pragma once

#include <Eigen/Core>
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

/// One cone a node of the body's hierarchy. A cone contains the normals of the faces below the node, and for the
/// vertices and edges that they own every direction in which the distance from the surface is locally least.
std::vector<NormalCone> normal_cones_of(const Body& body);

} // namespace chasles
