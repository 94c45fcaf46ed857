// A local minimum of the distance of two bodies over time. Source: docs/derivations/21-least-distance.md, "Upper
// bounds".
#pragma once

#include "chasles/search/nearest_features.h"
#include "chasles/search/piece_context.h"

namespace chasles::search {

/// Features that are near each other at one tau of a piece.
struct NearMoment {
    double tau = 0;
    NearestFeatures near;
};

/// Where the bodies are nearest among the ends and the middle of a piece. Empty if they are not nearer than `bound` at
/// any of these times.
std::optional<NearMoment> nearest_of_samples(const PieceContext& context, double bound, Work& work);

/// Follows the distance of the bodies downhill from features that are near at some tau. The result is no farther apart
/// than these features are.
NearMoment local_minimum(const PieceContext& context, double tau, const contact::FeaturePair& features, Work& work);

/// When these two features are nearest in a range of tau in which their distance has one minimum: where its rate is 0,
/// up to rounding, or at an end. If it has several, at one of them.
NearMoment minimum_between(const PieceContext& context, const contact::FeaturePair& features, const Bracket& taus);

} // namespace chasles::search
