// For how long the distance of two features stays no local minimum of the distance of the surfaces.
// Source: docs/derivations/17-hold.md, "Births are local minima".
#pragma once

#include "chasles/contact/feature_pair.h"
#include "chasles/search/piece_context.h"

namespace chasles::search {

/// The features are `margin` apart soon after `tau` (in [0, 1] of the piece). Returns a later time until which their
/// shortest connection leads against a face beside one of them, whenever they are that far apart; empty if it may not
/// do so at `tau`. `length` is that of the error scale. The margin must be positive.
std::optional<double> no_minimum_until(const PieceContext& context, const contact::FeaturePair& features, double tau,
                                       double margin, double length);

} // namespace chasles::search
