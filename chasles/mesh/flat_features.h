// The edges and vertices inside flat parts of a surface, which no first contact needs.
// Source: docs/derivations/20-flat-features.md.
#pragma once

#include "chasles/base/flat_lists.h"
#include "chasles/mesh/mesh_edges.h"

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

namespace chasles {

/// A flag for each edge and each vertex.
struct FlatFeatures {
    std::vector<char> edges;
    std::vector<char> vertices;
    bool has_any = false;
};

/// Finds the edges between two convex faces that lie in one plane, exactly and on different sides of the edge, and the
/// vertices at which every edge is such an edge. `triangles` is empty for the faces that are convex. On at most
/// `threads` threads (0: all cores).
[[nodiscard]] FlatFeatures find_flat_features(const FlatLists<std::uint32_t>& outlines,
                                              const FlatLists<std::uint32_t>& triangles, const MeshEdges& edges,
                                              std::span<const Eigen::Vector3d> vertices, unsigned threads = 1);

} // namespace chasles
