// The features of two bodies that are nearest at the start of a piece. Source: docs/derivations/16-margin.md,
// "Stages".
#pragma once

#include "chasles/contact/feature_pair.h"
#include "chasles/search/find.h"
#include "chasles/search/piece_context.h"

#include <vector>

namespace chasles::search {

/// Feature pairs that are near each other at tau = 0, and within the margin. A bounded search guesses the nearest ones.
/// Empty if it finds none.
std::vector<contact::FeaturePair> nearest_at_start(PieceContext& context, double margin, Work& work);

} // namespace chasles::search
