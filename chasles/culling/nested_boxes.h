// Which parts of one surface may lie inside of another body? Those with a point in its box, and by rays in double.
// Source: docs/derivations/37-inside.md, "When it is asked".
#pragma once

#include "chasles/culling/swept_boxes.h"
#include "chasles/mesh/body.h"

#include <cstdint>
#include <vector>

namespace chasles::culling {

/// One body in the frame of another one, both seen from the centres of their hierarchies; and how far any point may be
/// from its place, in the length unit.
struct PlacedPair {
    const Body& inner;
    const Body& outer;
    Placement placed;
    double slack;

    [[nodiscard]] PlacedPair swapped() const;
};

/// A vertex of each part of the inner body that has one in the box of the outer one, if that is solid: in the same
/// order for the same bodies. Many parts within a box that no face of the outer body comes near have one vertex in
/// common, which stands for them. Throws Cancelled at the limit of the thread.
std::vector<std::uint32_t> points_to_ask(const PlacedPair& pair);

/// False if no part of either body lies inside of the other one. True proves nothing.
bool may_be_nested(const PlacedPair& pair);

} // namespace chasles::culling
