// Does one body lie inside of the other one at the start? Surfaces that never touch cannot change that.
// Source: docs/derivations/37-inside.md.
#pragma once

#include "chasles/search/piece_context.h"

#include <cstdint>
#include <optional>

namespace chasles::search {

/// A vertex of one body that lies inside of the other one.
struct Nested {
    bool moving_is_inside;
    std::uint32_t vertex;
    bool certain; ///< false if it may just be outside, nearer to the surface than rounding
};

/// Such a vertex at the start of the first piece. Where the surfaces do not touch, one vertex stands for its part;
/// parts that a box excludes are not asked. Throws Cancelled at the limit of the thread.
std::optional<Nested> nested_at_start(PieceContext& context);

} // namespace chasles::search
