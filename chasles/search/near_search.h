// A search with a margin: the earliest time at which features come within it.
// Source: docs/derivations/16-margin.md and 17-hold.md.
#pragma once

#include "chasles/search/piece_search.h"

namespace chasles::search {

/// Feature pairs that are within the margin at the start and may stay so.
class HeldContacts {
public:
    HeldContacts() = default;
    explicit HeldContacts(std::vector<contact::FeaturePair> pairs);

    [[nodiscard]] bool has(const contact::FeaturePair& pair) const;

private:
    std::vector<contact::FeaturePair> pairs_; ///< sorted
};

/// With `held`, what is found are new contacts only: local minima of the distance that fall to the margin.
PieceResult search_piece_with_margin(const PieceSearch& search);

} // namespace chasles::search
