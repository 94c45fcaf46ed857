// A search with a margin: the earliest time at which features come within it.
// Source: docs/derivations/16-margin.md and 17-hold.md.
#pragma once

#include "chasles/query/traversal.h"

namespace chasles::query {

/// Feature pairs that are within the margin at the start and may stay so.
class HeldContacts {
public:
    HeldContacts() = default;
    explicit HeldContacts(std::vector<FeaturePair> pairs);

    [[nodiscard]] bool has(const FeaturePair& pair) const;

private:
    std::vector<FeaturePair> pairs_; ///< sorted
};

/// With `held`, what is found are new contacts only: local minima of the distance that fall to the margin.
PieceResult search_piece_with_margin(const PieceSearch& search);

} // namespace chasles::query
