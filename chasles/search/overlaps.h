// Edges of one body that pass through faces of the other at the start of a motion.
// Source: docs/derivations/05-being-inside.md, last section.
#pragma once

#include "chasles/motion/motion_ends.h"
#include "chasles/search/candidate.h"

namespace chasles::search {

/// Calls `found` for every owned edge of either face that the filter cannot tell from one that passes through the
/// other.
template <class Found>
void look_for_overlaps(FeaturePairs<double>& filter, const Body& moving, std::uint32_t moving_face, const Body& fixed,
                       std::uint32_t fixed_face, Found found) {
    using elementary::Ends;
    for (const Edge& edge : moving.owned_edges(moving_face))
        if (filter.moving_edge_passage(edge, fixed_face, Ends::not_proven_on_one_side))
            found(Overlap{true, {edge.from, edge.to}, {fixed_face, fixed_face}, {}, false});
    for (const Edge& edge : fixed.owned_edges(fixed_face))
        if (filter.fixed_edge_passage(edge, moving_face, Ends::not_proven_on_one_side))
            found(Overlap{false, {edge.from, edge.to}, {moving_face, moving_face}, {}, false});
}

/// What double-double makes of it: its point, in the fixed body's frame, and whether it is certain. None if there is no
/// passage. Doubt is left where an end of the edge is hardly off the face's plane, or the edge hardly within its rim.
std::optional<Overlap> refined(const Overlap& overlap, FeaturePairs<algebra::DoubleDouble>& pairs,
                               const MotionFrame& frame);

} // namespace chasles::search
