// Edges of one body that pass through faces of the other body at the start of a motion.
// Source: docs/derivations/05-being-inside.md, last section.
#pragma once

#include "chasles/search/feature_tests.h"
#include "chasles/search/owned_pairs.h"

namespace chasles::search {

/// Calls `visit(overlap)` for every owned edge of either face that the filter cannot separate from an edge that passes
/// through the other face.
template <class Visit>
void for_each_possible_overlap(FeatureTests<double>& filter, const Body& moving, const Body& fixed,
                               const TwoFaces& faces, Visit visit) {
    const auto test = [&](const Overlap& overlap) {
        if (filter.passage(overlap, elementary::Ends::not_proven_on_one_side))
            visit(overlap);
    };
    for (const Edge& edge : moving.owned_edges(faces.moving))
        test({true, {edge.from, edge.to}, {faces.fixed, faces.fixed}, Eigen::Vector3d::Zero(), false});
    for (const Edge& edge : fixed.owned_edges(faces.fixed))
        test({false, {edge.from, edge.to}, {faces.moving, faces.moving}, Eigen::Vector3d::Zero(), false});
}

/// The overlap as double-double decides it: its point, in the fixed body's frame, and whether it is certain. Empty if
/// the edge does not pass. Uncertain where an end of the edge is barely off the face's plane, or the edge barely within
/// the face's rim. `cubic` is the motion of the piece.
std::optional<Overlap> refined(const Overlap& overlap, FeatureTests<algebra::DoubleDouble>& tests,
                               const motion::RationalMotion<algebra::DoubleDouble>& cubic);

} // namespace chasles::search
