// The distinct edges of a set of faces, and the edge of each side of each face.
// The edges do not depend on the order of the faces.
#pragma once

#include "chasles/base/flat_lists.h"
#include "chasles/mesh/edge.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace chasles {

/// The edges of a mesh. A side is the part of an outline between two consecutive corners.
struct MeshEdges {
    static constexpr std::uint32_t none = 0xffffffff;

    std::vector<Edge> edges;                             ///< in ascending order
    std::vector<std::array<std::uint32_t, 2>> two_faces; ///< the faces of each edge that has two sides, otherwise none
    std::vector<std::uint32_t> edge_of_side; ///< for corner i of all outlines: the edge to the next corner, or none
    std::vector<UnpairedEdge> unpaired;      ///< in ascending order
    std::size_t boundary = 0;                ///< edges with one face
    std::size_t nonmanifold = 0;             ///< edges with three faces or more

    /// The edges whose lower vertex is `vertex`. Not after `append_segments`.
    [[nodiscard]] std::span<const Edge> edges_from(std::uint32_t vertex) const;

    /// Appends the edges of faces without area, each an outline a, b, b with an edge that no other face has.
    void append_segments(const FlatLists<std::uint32_t>& outlines);
};

/// Collects all edges. If one outline uses a side in both directions, as the bridge between an outline and its hole,
/// the side is a cut inside the face. It is an edge only if another face has it.
[[nodiscard]] MeshEdges collect_edges(const FlatLists<std::uint32_t>& outlines, std::size_t vertex_count);

} // namespace chasles
