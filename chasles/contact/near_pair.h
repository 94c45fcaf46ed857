// Whether two features are within a distance of each other at one moment, and whether they are a contact.
// Source: docs/derivations/18-contact-set.md, "Which pairs".
#pragma once

#include "chasles/contact/contact_frame.h"

namespace chasles::contact {

/// Whether the distance of two features is at most the margin, up to the slack. The nearest points must be in the
/// relative interiors of both features, up to the slack; features that touch need not. Other features are nearer, or as
/// near, where they are not.
bool are_near(const ContactScene& scene, const FeaturePair& features);

/// Whether the features are near, and touch or are at a local minimum of the distance of both surfaces.
bool are_in_contact(const ContactScene& scene, const FeaturePair& features);

/// Whether the distance of features at these points is a local minimum, up to the slack.
bool is_local_minimum(const ContactScene& scene, const FeaturePair& features, const NearestPoints& nearest);

} // namespace chasles::contact
