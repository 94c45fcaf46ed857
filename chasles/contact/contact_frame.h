// Point, normal, gap and approach speed of a feature pair in contact.
// Source: docs/derivations/08-contact-frame.md.
#pragma once

#include "chasles/contact/relative_configuration.h"
#include "chasles/elementary/error_scale.h"

namespace chasles::contact {

/// A descent of the distance (a cosine) up to this still counts as a local minimum.
struct Slopes {
    double vertex_face = 0; ///< of pairs whose normal is that of the face
    double others = 0;      ///< of pairs whose normal is tilted by it

    [[nodiscard]] double of(ContactKind kind) const {
        return kind == ContactKind::vertex_face || kind == ContactKind::face_vertex ? vertex_face : others;
    }
};

/// The bodies at the time of the contacts to be described.
struct ContactScene {
    const RelativeConfiguration& bodies;
    bool at_start = false; ///< at time 0 the velocity does not tell the side of the contact
    double margin = 0;     ///< distance that counts as contact; 0: features touch
    double slack = 0;      ///< bound for the distance of points from their places at the contact, mesh unit
    Slopes slopes = {};    ///< of pairs that count as local minima
};

/// A bound for the distance of points from their places at the contact, at a tau within `width` of the contact.
double touch_slack(const RelativeConfiguration& bodies, const elementary::ErrorScale& scale, double width);

/// The contact of two features, in the frame of the fixed body, named for these features. Its approach_speed is per
/// unit of tau.
Contact described(const ContactScene& scene, const FeaturePair& features);

} // namespace chasles::contact
