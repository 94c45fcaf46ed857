// Point, normal, gap and approach speed of a feature pair in contact.
// Source: docs/derivations/08-contact-frame.md.
#pragma once

#include "chasles/contact/relative_configuration.h"
#include "chasles/elementary/error_scale.h"

namespace chasles::contact {

/// The bodies at the time of the contacts to be described.
struct ContactScene {
    const RelativeConfiguration& instant;
    bool at_start = false; ///< at time 0 the velocity does not tell the side of the contact
    double margin = 0;     ///< distance that counts as contact; 0: features touch
    double slack = 0;      ///< bound for the distance of points from their places at the contact, mesh unit
};

/// How far points may be off at an instant that is no further than `width` from the contact.
double touch_slack(const RelativeConfiguration& instant, const elementary::ErrorScale& scale, double width);

/// In the frame of the fixed body; `approach_speed` is per unit of tau. Features are taken as they are named.
Contact described(const ContactScene& scene, const FeaturePair& features);

} // namespace chasles::contact
