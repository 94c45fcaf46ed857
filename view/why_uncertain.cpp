#include "view/why_uncertain.h"

#include "chasles/base/number_text.h"

#include <algorithm>
#include <cmath>

namespace chasles::view {
namespace {

/// A bracket that is wider was left by bounds of the motion, not by rounding.
constexpr double width_by_rounding = 1e-7;

/// Whether no feature pair closes: the features slide along each other, or only touch.
bool closes_nowhere(const FirstContact& found) {
    return !found.contacts.empty() &&
           std::ranges::none_of(found.contacts, [](const Contact& contact) { return contact.approach_speed > 0; });
}

/// How far apart the nearest of the reported features are at the lower end of the bracket, computed in double.
std::string with_distance(const std::string& reason, const FirstContact& found) {
    if (found.contacts.empty())
        return reason;
    double least = std::abs(found.contacts.front().gap);
    for (const Contact& contact : found.contacts)
        least = std::min(least, std::abs(contact.gap));
    return reason + "; they are " + number_text(least, 9) + " apart where the bracket begins, in double precision";
}

/// For a contact that is neither an overlap nor one body inside of the other one.
std::string why_touch_is_uncertain(const FirstContact& found, bool ends_there) {
    if (found.verdict == Verdict::contact && found.time.upper - found.time.lower > width_by_rounding)
        return "the bounds of the motion do not tell contact from a miss of the bodies within this bracket";
    if (ends_there && found.verdict == Verdict::contact && found.time.upper >= 1)
        return "the bodies just reach each other at the end of the motion, and a rounding error decides whether they "
               "meet";
    if (closes_nowhere(found))
        return "the features named here slide along or graze each other, and a rounding error decides whether they "
               "meet";
    return "a rounding error decides whether the features named here meet";
}

} // namespace

std::string why_uncertain(const FirstContact& found, bool ends_there) {
    if (found.inside)
        return "the vertex that seems to be inside is next to the surface, and may be outside by a rounding error";
    if (found.overlap)
        return "a rounding error decides whether the edge named here passes through the face, or misses its rim";
    return with_distance(why_touch_is_uncertain(found, ends_there), found);
}

} // namespace chasles::view
