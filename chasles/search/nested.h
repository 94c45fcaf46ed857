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

/// A vertex of a part of either surface that lies inside of the other body at the start of the first piece, if that
/// body is solid. Of each part that a box does not exclude, one vertex is asked: where surfaces do not touch, it stands
/// for its part.
std::optional<Nested> nested_at_start(PieceContext& context);

} // namespace chasles::search
