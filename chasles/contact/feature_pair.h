// A pair of features, one of each body.
#pragma once

#include "chasles/contact/contact.h"

namespace chasles::contact {

/// A feature of the moving body and one of the fixed body. Faces have the ids of the library's bodies, not of the
/// input.
struct FeaturePair {
    ContactKind kind = ContactKind::vertex_face;
    Feature moving;
    Feature fixed;

    friend auto operator<=>(const FeaturePair&, const FeaturePair&) = default;
};

} // namespace chasles::contact
