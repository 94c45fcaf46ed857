// Contacts that bodies have at the start of a motion and may keep. Source: docs/derivations/17-hold.md.
#pragma once

#include "chasles/contact/feature_pair.h"

#include <algorithm>
#include <vector>

namespace chasles::search {

/// Feature pairs that are within the margin at the start.
class HeldContacts {
public:
    explicit HeldContacts(std::vector<contact::FeaturePair> pairs) : pairs_(std::move(pairs)) {
        std::ranges::sort(pairs_);
    }

    [[nodiscard]] bool has(const contact::FeaturePair& pair) const { return std::ranges::binary_search(pairs_, pair); }

private:
    std::vector<contact::FeaturePair> pairs_; ///< sorted
};

} // namespace chasles::search
