// A feature pair that may be in contact.
#pragma once

#include "chasles/algebra/first_feasible.h"
#include "chasles/contact/feature_pair.h"

namespace chasles::search {

using algebra::FeasibleInterval;
using contact::FeaturePair;

/// A feature pair with the tau of its first contact in the piece of motion.
struct Candidate : FeaturePair {
    FeasibleInterval tau;
};

/// An uncertain candidate that starts within this part of the piece before a proven contact, or after it, is postponed.
inline constexpr double nearly_simultaneous = 0x1p-30;

/// The exact stage separates a touch at tau = 0, whose bracket is that number, from one before the least double above
/// it. A candidate that it leaves uncertain may be at the start.
inline bool may_be_at_start(const FeasibleInterval& tau) {
    return tau.lower <= 0 && (tau.upper <= 0 || !tau.certain);
}

} // namespace chasles::search
