// What a search of one piece of motion finds: feature pairs by their ids, and how any stage is asked about one.
#pragma once

#include "chasles/contact/feature_pair.h"
#include "chasles/search/feature_pairs.h"
#include "chasles/search/find.h"

namespace chasles::search {

/// A feature pair that may be in contact, with the tau of its first contact in the piece of motion.
struct Candidate : contact::FeaturePair {
    FeasibleInterval tau;
};

/// What is in doubt and begins no earlier than a proven contact by more waits until that one's bracket is narrow.
inline constexpr double nearly_simultaneous = 0x1p-30;

/// The exact stage tells a touch at tau = 0, whose bracket is that number, from one before the least double above it.
/// What it leaves in doubt may be at the start.
inline bool may_be_at_start(const FeasibleInterval& tau) {
    return tau.lower <= 0 && (tau.upper <= 0 || !tau.certain);
}

/// The first contact of the candidate's features as this stage sees it.
template <class S>
std::optional<FeasibleInterval> first_contact_of(FeaturePairs<S>& pairs, const Candidate& candidate) {
    const Edge moving{candidate.moving.first, candidate.moving.second};
    const Edge fixed{candidate.fixed.first, candidate.fixed.second};
    switch (candidate.kind) {
    case ContactKind::vertex_face:
        return pairs.vertex_face(moving.from, fixed.from);
    case ContactKind::face_vertex:
        return pairs.face_vertex(moving.from, fixed.from);
    case ContactKind::edge_edge:
        return pairs.edge_edge(pairs.path_of(moving), fixed);
    default: // features that touch there do so as one of these
        return std::nullopt;
    }
}

/// Whether the overlap's edge may go through its face at the start.
template <class S>
std::optional<elementary::Passage<S>> passage_of(FeaturePairs<S>& pairs, const Overlap& overlap,
                                                 elementary::Ends ends) {
    const Edge edge{overlap.edge.first, overlap.edge.second};
    return overlap.edge_is_moving ? pairs.moving_edge_passage(edge, overlap.face.first, ends)
                                  : pairs.fixed_edge_passage(edge, overlap.face.first, ends);
}

} // namespace chasles::search
