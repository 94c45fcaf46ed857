// Assigns each vertex or edge to exactly one of its faces.
// A search over pairs of faces then tests each pair of features once.
#pragma once

#include "chasles/base/flat_lists.h"

#include <cstdint>
#include <span>
#include <vector>

namespace chasles {

inline constexpr std::uint32_t no_feature = 0xffffffff;

/// Returns the features that each face owns. `features[offsets[f]]` to `features[offsets[f + 1] - 1]` are the features
/// of face f: places in `is_left_out`, or no_feature. Exactly one face owns each feature that occurs. The shares are
/// even, because the faces take turns. `is_left_out` has a flag for each feature; no face owns those that are left out.
[[nodiscard]] FlatLists<std::uint32_t> share_features(std::span<const std::uint32_t> offsets,
                                                      std::span<const std::uint32_t> features,
                                                      const std::vector<char>& is_left_out);

} // namespace chasles
