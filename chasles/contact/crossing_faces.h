// Two faces that pass through each other at one moment, with the rims of their bodies in common planes or not.
// Source: docs/derivations/05-being-inside.md, "A face through a face at the start".
#pragma once

#include "chasles/contact/relative_configuration.h"

namespace chasles::contact {

/// Whether it is proven that a point lies inside both faces, at which their planes cross. Points of the configuration
/// are off by at most `error`, in the length unit. Touching faces and faces in one plane do not cross.
bool are_crossing(const RelativeConfiguration& bodies, std::uint32_t moving_face, std::uint32_t fixed_face,
                  double error);

} // namespace chasles::contact
