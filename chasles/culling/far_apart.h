// Bodies that a whole motion does not bring near each other, told by a ball around each, before anything else is made.
// Source: docs/derivations/07-swept-boxes.md, "Far apart".
#pragma once

#include "chasles/mesh/body.h"
#include "chasles/motion/motion_ends.h"

namespace chasles::culling {

/// Proven never to come within the margin on the whole screw or sweep, however far it turns. False says nothing.
bool are_far_apart(const Body& moving, const Body& fixed, const MotionEnds& ends, double margin = 0);

} // namespace chasles::culling
