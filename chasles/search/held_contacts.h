// Contacts that bodies have at the start of a motion and may keep. Source: docs/derivations/17-hold.md.
#pragma once

#include "chasles/contact/near_pair.h"

namespace chasles::search {

/// The feature pairs that are within a margin at the start.
class HeldContacts {
public:
    /// `start` is kept by reference.
    explicit HeldContacts(const contact::ContactScene& start) : start_(start) {}

    [[nodiscard]] bool has(const contact::FeaturePair& pair) const { return contact::NearTest(start_).are_near(pair); }

private:
    const contact::ContactScene& start_;
};

} // namespace chasles::search
