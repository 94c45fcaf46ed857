// What verdicts say.
#pragma once

#include "chasles/query/least_distance.h"

namespace chasles::view {

/// Also at the start.
inline bool is_contact(Verdict verdict) {
    return verdict == Verdict::contact || verdict == Verdict::contact_at_start;
}

/// Throws InvalidInput for `unknown`: a page shows an answer.
void require_answer(Verdict verdict);

/// `clear` if the bodies are proven to stay apart, `contact` or `contact_at_start` if they are proven to touch, and
/// `unknown` if neither is proven.
Verdict proven_verdict(const LeastDistance& found);

} // namespace chasles::view
