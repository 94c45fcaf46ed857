// The pairs of a matrix of least distances as a list that people read: the same on the command line and in Python.
#pragma once

#include "chasles/scene/scene.h"

#include <cstddef>
#include <string>
#include <vector>

namespace chasles::view {

/// So many pairs have a line each.
inline constexpr std::size_t most_pairs_in_text = 100;

/// Pairs in contact by their times, then all others by their distances; at most `most_pairs_in_text`.
std::vector<const PairDistance*> nearest_first(const DistanceMatrix& matrix);

/// "0.25", or "0 to 0.3" if the distance is not certain.
std::string distance_text(const LeastDistance& nearest);

} // namespace chasles::view
