#include "view/why_uncertain.h"

#include <algorithm>

namespace chasles::view {
namespace {

/// A bracket that is wider was left by bounds of the motion, not by rounding.
constexpr double width_by_rounding = 1e-7;

/// Whether no feature pair closes: the features slide along each other, or only touch.
bool closes_nowhere(const FirstContact& found) {
    return !found.contacts.empty() &&
           std::ranges::none_of(found.contacts, [](const Contact& contact) { return contact.approach_speed > 0; });
}

} // namespace

std::string why_uncertain(const FirstContact& found, bool ends_there) {
    if (found.inside)
        return "the vertex that seems to be inside is next to the surface, and may be outside by a rounding error";
    if (found.overlap)
        return "an edge may just miss the rim of a face that it seems to pass through";
    if (found.verdict == Verdict::contact && found.time.upper - found.time.lower > width_by_rounding)
        return "the bounds of the motion do not tell contact from a miss within this bracket";
    if (ends_there && found.verdict == Verdict::contact && found.time.upper >= 1)
        return "the bodies just reach each other at the end of the motion, and may miss by a rounding error";
    if (closes_nowhere(found))
        return "the bodies slide along or graze each other there, and may miss each other by a rounding error";
    return "the bodies may miss each other by a rounding error";
}

} // namespace chasles::view
