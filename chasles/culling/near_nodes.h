// A guess whether two bodies are near each other at one moment. It proves nothing.
// Source: docs/derivations/23-coarse-motion.md, "When the test gives up".
#pragma once

#include "chasles/culling/swept_boxes.h"
#include "chasles/hierarchy/bvh.h"

namespace chasles::culling {

/// A pair of nodes is small if all sides are shorter than this part of the size of the smaller body.
inline constexpr double small_side = 0.25;

/// The size of a body: the longest side of the box around it.
inline double size_of(const Bvh& body) {
    return double(longest_side(body.nodes()[0]));
}

/// Descends from both roots to small nodes, each time to the child with the nearest centre. True if the centres of the
/// small nodes are nearer than 0.28 of the smaller body's size plus the margin.
bool have_near_nodes(const Bvh& moving, const Bvh& fixed, const Placement& placed, double margin);

} // namespace chasles::culling
