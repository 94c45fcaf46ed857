// The distinct edges of a set of faces, and which edge each side of each face is.
#pragma once

#include "chasles/base/flat_lists.h"
#include "chasles/mesh/edge.h"

#include <cstdint>
#include <span>
#include <vector>

namespace chasles {

struct MeshEdges {
    static constexpr std::uint32_t none = 0xffffffff;

    std::vector<Edge> edges;                 ///< in ascending order
    std::vector<std::uint32_t> edge_of_side; ///< for corner i of all outlines: the edge from it to the next, or none
    std::size_t boundary = 0;                ///< edges with one face
    std::size_t nonmanifold = 0;             ///< edges with three faces or more

    [[nodiscard]] bool contains(std::uint32_t a, std::uint32_t b) const;
};

/// A side that one outline uses to and fro (the bridge between an outline and its hole) is a cut inside the face and
/// no edge, unless another face has it.
[[nodiscard]] MeshEdges collect_edges(const FlatLists<std::uint32_t>& outlines, std::size_t vertex_count);

} // namespace chasles
