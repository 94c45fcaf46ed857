// The set of contacts at one time: each contact once, named for its features, flat contacts by their corners.
// Source: docs/derivations/18-contact-set.md.
#pragma once

#include "chasles/contact/contact_frame.h"

#include <vector>

namespace chasles::contact {

/// The contacts of these feature pairs, in the frame of the fixed body, in the order of their features.
///
/// A vertex on the rim of a face is named for the edge or vertex of the rim, unless the surface continues flat there.
///
/// Parallel edges touch at the two ends of their common part.
///
/// With a margin, only local minima of the distance are contacts.
///
/// Contacts in one plane with one normal are reduced to the corners of their convex hull.
std::vector<Contact> contact_set(const ContactScene& scene, const std::vector<FeaturePair>& candidates);

/// The contact of one feature pair. Features that touch at a rim get the name of the vertex or edge there, if the
/// normal of that name separates the features and the first one's does not, or if the motion closes against that normal
/// only.
Contact named_contact(const ContactScene& scene, const FeaturePair& features);

/// The features on which two points of these features are: the edge or vertex of a rim, the end of an edge.
FeaturePair features_at(const ContactScene& scene, const FeaturePair& features, const NearestPoints& points);

/// Whether the motion closes the gap of a contact in the fixed body's frame, by more than rounding.
bool is_closing(const ContactScene& scene, const Contact& contact);

} // namespace chasles::contact
