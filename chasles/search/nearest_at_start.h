// Features that are near each other at the start of a piece. Source: docs/derivations/16-margin.md,
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

/// Whether two features are proven to have points within the margin of each other at a tau, wherever on the features
/// these points are. The tests of features leave that open where the nearest points are at their rims.
bool are_within(const PieceContext& context, double tau, const contact::FeaturePair& features, double margin);

} // namespace chasles::search
