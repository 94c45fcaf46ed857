#include "view/proven_verdict.h"

#include "chasles/base/invalid_input.h"

namespace chasles::view {

void require_answer(Verdict verdict) {
    if (verdict == Verdict::unknown)
        throw InvalidInput("view: the limit was reached before the answer, so there is nothing to show");
}

Verdict proven_verdict(const LeastDistance& found) {
    if (found.distance.lower > 0)
        return Verdict::clear;
    if (found.distance.upper > 0)
        return Verdict::unknown;
    return found.time.upper > 0 ? Verdict::contact : Verdict::contact_at_start;
}

} // namespace chasles::view
