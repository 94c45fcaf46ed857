#include "chasles/manipulation/near_contacts.h"

#include "chasles/base/sort.h"
#include "chasles/motion/motion.h"
#include "chasles/query/report.h"
#include "chasles/search/nested.h"

#include <algorithm>

namespace chasles::manipulation {

namespace {

/// A corner of a box that is tilted by a hair is no local minimum of the distance from a table, but stops the box as
/// soon as it turns. So pairs count where the distance falls by up to these cosines beside them. Edges whose normal is
/// tilted more would be walls that are not there: ridges of facets that lie behind each other would hold a nut.
constexpr contact::Slopes most_slopes{0.25, 0x1p-5};
/// A nut of 13,000 triangles with micrometres of play has 360,000 pairs of nodes to visit. A search that is cut before
/// it has found anything lists nothing, and its distance is 0.
constexpr std::uint64_t most_visits = 1 << 20;
/// A nut that is lifted touches everywhere at once, and a list of all pairs is cut.
constexpr int refinements = 4;

} // namespace

NearContacts near_contacts(const PlacedBody& moving, const PlacedBody& fixed, double reach, search::Memory& memory) {
    const ScrewMotion rest = ScrewMotion::relative(moving.pose, moving.pose, fixed.pose, fixed.pose);
    const auto pieces = Motion(rest).trajectory().pieces();
    search::PieceContext context(moving.body, fixed.body, pieces->at(0));
    const double radii = distance_of_polyhedra(moving.body, fixed.body, 0);
    const query::ContactMoment moment(context, reach + radii, most_slopes);
    search::NearFeatures near =
        moment.find({.most_visits = most_visits, .refinements = refinements, .finds_overlaps = true, .memory = memory});
    chasles::sort(near.pairs); // what is remembered changes their order
    const bool overlaps = near.overlap || search::nested_at_start(context);
    NearContacts found{{}, reach, overlaps, near.is_cut, near.work};
    if (found.overlaps) {
        found.distance = 0;
        return found;
    }
    if (near.is_cut)
        found.distance = std::clamp(near.complete_within - radii, 0.0, reach);
    if (!near.pairs.empty())
        found.contacts = moment.contacts_of(near.pairs);
    found.is_cut = query::cut_to_most(found.contacts) || near.is_cut;
    for (const Contact& contact : found.contacts)
        found.distance = std::min(found.distance, contact.gap);
    return found;
}

} // namespace chasles::manipulation
