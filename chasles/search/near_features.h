// The feature pairs that are in contact at one moment, all of them: a traversal of both hierarchies at rest.
// Source: docs/derivations/18-contact-set.md, "Which pairs"; docs/derivations/19-normal-cones.md.
#pragma once

#include "chasles/contact/contact_frame.h"
#include "chasles/search/find.h"
#include "chasles/search/memory.h"
#include "chasles/search/piece_context.h"

#include <vector>

namespace chasles::search {

/// What is near at one tau of a piece.
struct NearFeatures {
    std::vector<contact::FeaturePair> pairs; ///< each once, in the order of the search
    bool is_cut = false;                     ///< there may be more pairs than these
    double complete_within = 0;              ///< every pair within this distance is listed
    std::optional<Overlap> overlap;          ///< the point is in the frame of the fixed body
    Work work;
};

/// How to search.
struct NearSearch {
    std::size_t most_pairs = 1 << 12;    ///< feature pairs to list
    std::uint64_t most_visits = 1 << 16; ///< pairs of nodes to visit at one distance
    int refinements = 0;                 ///< of the distance within which a list that is cut is complete
    bool finds_overlaps = false;         ///< also edges that pass through faces; only at tau = 0
    bool finds_crossing_faces = false;   ///< also faces that are proven to pass through each other; only at tau = 0
    Memory& memory = no_memory();        ///< of both bodies
};

/// The feature pairs of a scene that touch or, with a margin, are within it at a local minimum of the distance
/// (`contact::NearTest`). `tau` is that of the scene.
///
/// At the start, bodies may be much nearer than the margin, and many pairs within it. If a bound of the search is
/// reached, the pairs are searched for at growing distances: the margin by powers of two and, where all of these are
/// cut in which something is near, so from the least distance on. The answer is that of the greatest distance that the
/// bounds allow, or between two of them by `refinements` bisections. It always has a pair at the least distance.
NearFeatures near_features(PieceContext& context, const contact::ContactScene& scene, double tau,
                           const NearSearch& search);

} // namespace chasles::search
