// Gives each vertex or edge to exactly one of the faces that have it, so that no pair of features is met twice.
#pragma once

#include "chasles/base/flat_lists.h"

#include <cstdint>
#include <span>

namespace chasles {

inline constexpr std::uint32_t no_feature = 0xffffffff;

/// `features[offsets[f] .. offsets[f + 1]]` are the features of face f (ids below `feature_count`, or no_feature).
/// Answers which features each face owns. Each feature that occurs is owned once, and the shares are even: faces take
/// one feature each, turn by turn.
[[nodiscard]] FlatLists<std::uint32_t> share_features(std::span<const std::uint32_t> offsets,
                                                      std::span<const std::uint32_t> features,
                                                      std::size_t feature_count);

} // namespace chasles
