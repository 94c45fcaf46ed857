// An edge of a body, named by the ids of its vertices.
// Each edge of a body is stored once.
#pragma once

#include <cstdint>

namespace chasles {

/// One edge between two vertices, `from` < `to`.
struct Edge {
    std::uint32_t from;
    std::uint32_t to;
};

/// An edge that faces do not run along equally often in both directions.
struct UnpairedEdge {
    Edge edge;
    int surplus; ///< how many more times from the lower to the higher vertex
};

} // namespace chasles
