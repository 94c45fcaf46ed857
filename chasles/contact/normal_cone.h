// The normal of a contact at a vertex or on an edge: one of those that both features allow.
// Source: docs/derivations/08-contact-frame.md, "At rims and tips".
#pragma once

#include "chasles/contact/relative_configuration.h"

namespace chasles::contact {

/// From the middle of the fixed body's box to that of the moving one.
Eigen::Vector3d outward_direction(const RelativeConfiguration& instant);

/// Of unit normals that lead away from the fixed feature and from which the moving one leads away, the one along which
/// the features were apart just before: the limit of the shortest way between them. At the start that as if the moving
/// body had come from where the middle of its box is.
Eigen::Vector3d normal_between_cones(const RelativeConfiguration& instant, const FeaturePair& features, bool at_start);

} // namespace chasles::contact
