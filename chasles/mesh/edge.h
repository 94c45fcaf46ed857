// An edge of a body.
#pragma once

#include <cstdint>

namespace chasles {

/// One edge between two vertices, `from` < `to`.
struct Edge {
    std::uint32_t from;
    std::uint32_t to;
};

} // namespace chasles
