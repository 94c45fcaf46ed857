#include "view/proven_verdict.h"

namespace chasles::view {

Verdict proven_verdict(const LeastDistance& found) {
    if (found.distance.lower > 0)
        return Verdict::clear;
    if (found.distance.upper > 0)
        return Verdict::unknown;
    return found.time.upper > 0 ? Verdict::contact : Verdict::contact_at_start;
}

} // namespace chasles::view
