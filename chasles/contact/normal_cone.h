// The normal of a contact at a vertex or on an edge: one of those that both features allow.
// Source: docs/derivations/08-contact-frame.md, "At rims and tips".
#pragma once

#include "chasles/contact/relative_configuration.h"

namespace chasles::contact {

/// From the middle of the fixed body's box to that of the moving one.
Eigen::Vector3d outward_direction(const RelativeConfiguration& bodies);

/// A unit normal that both features allow: it leads away from the fixed feature, and the moving feature leads away from
/// it. The choice is the direction that separated the features just before the contact, which is the limit of the
/// shortest connection between them. At the start, the moving body counts as if it came from the middle of its box.
Eigen::Vector3d normal_between_cones(const RelativeConfiguration& bodies, const FeaturePair& features, bool at_start);

/// Whether both features allow a unit normal. The features are a vertex or an edge of each body.
bool separates(const Eigen::Vector3d& normal, const RelativeConfiguration& bodies, const FeaturePair& features);

} // namespace chasles::contact
