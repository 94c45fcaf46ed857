// The directions from the vertices and edges of a body into its surface, as planes that bound where a locally nearest
// point may be. Source: docs/derivations/17-hold.md, "Before any root".
#pragma once

#include "chasles/base/flat_lists.h"

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace chasles {

class Body;

/// Lists of directions into the surface, for the features that faces own. All have length one, except the first
/// one of several: it is the mean of the others. Directions that rounding makes unreliable are left out.
struct FeatureWays {
    std::vector<std::uint32_t> first_vertex; ///< for each face: the number of the first vertex that it owns
    std::vector<std::uint32_t> first_edge;   ///< likewise for edges
    FlatLists<Eigen::Vector3d> of_vertex;    ///< by the number of the vertex
    FlatLists<Eigen::Vector3d> of_edge;      ///< by the number of the edge, across it
};

FeatureWays feature_ways_of(const Body& body);

} // namespace chasles
