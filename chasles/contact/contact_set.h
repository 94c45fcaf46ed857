// All that touches at once, each contact once, named for what it is, and no more than it takes.
// Source: docs/derivations/18-contact-set.md.
#pragma once

#include "chasles/contact/contact_frame.h"

#include <vector>

namespace chasles::contact {

/// The contacts of these candidates, in the frame of the fixed body, in the order of their features:
///  - features that touch at their rims are named for these: a vertex on the rim of a face is on its edge, or on a
///    vertex of it, unless the surface goes on flat there; parallel edges touch at the two ends of what they share;
///  - with a margin, only local minima of the distance;
///  - of contacts in one plane with one normal, those at the corners of the hull of all of them.
std::vector<Contact> contact_set(const ContactScene& scene, const std::vector<FeaturePair>& candidates);

} // namespace chasles::contact
