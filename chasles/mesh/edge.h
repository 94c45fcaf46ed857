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

} // namespace chasles
