// Properties of every answer, for any query.
#pragma once

#include "chasles/query/first_contact.h"
#include "tests/fuzz/bytes.h"

#include <cmath>

namespace chasles::fuzz {

/// Far above the work that any small pair of bodies has needed. A stalled search exceeds this limit at once.
inline constexpr std::uint64_t most_work = 2'000'000;

inline void demand_bracket(const Bracket& bracket) {
    demand(bracket.lower >= 0 && bracket.upper <= 1, "brackets are within [0, 1]");
    demand(bracket.lower <= bracket.upper, "brackets are in order");
}

inline void demand_sound(const Contact& contact) {
    demand(contact.point.allFinite(), "contact points are finite");
    demand(std::abs(contact.normal.norm() - 1) < 1e-9, "contact normals have unit length");
    demand(std::isfinite(contact.approach_speed), "approach speeds are finite");
}

inline void demand_sound(const FirstContact& found, Find find) {
    demand_bracket(found.time);
    demand_bracket(found.tau);
    demand(found.pose.translation.allFinite() && found.pose.rotation.coeffs().allFinite(), "poses are finite");
    demand(found.work.node_pairs + found.work.elementary_tests < most_work, "work is bounded");
    for (const Contact& contact : found.contacts)
        demand_sound(contact);
    if (found.overlap)
        demand(found.overlap->point.allFinite(), "overlap points are finite");
    if (found.inside)
        demand(found.inside->point.allFinite(), "points inside are finite");
    const bool has_feature = !found.contacts.empty() || found.overlap || found.inside;
    demand(has_feature == (found.verdict != Verdict::clear), "a contact has features, and clear has none");
    demand((!found.overlap && !found.inside) || found.verdict == Verdict::contact_at_start,
           "overlaps and bodies inside of each other are at the start");
    demand(!found.inside || (found.contacts.empty() && !found.overlap), "surfaces that meet say more than inside");
    demand(find == Find::first_with_all_contacts || found.contacts.size() <= 1,
           "one feature pair unless all are wanted");
}

} // namespace chasles::fuzz
