// A test with one ball around each body. It proves before any other work that a whole motion keeps the bodies apart.
// Source: docs/derivations/07-swept-boxes.md, "Far apart".
#pragma once

#include "chasles/mesh/body.h"
#include "chasles/motion/motion_ends.h"

namespace chasles::culling {

/// Whether the bodies are proven to stay farther apart than the margin during the whole screw or sweep, for any angle
/// of rotation. False proves nothing.
bool are_far_apart(const Body& moving, const Body& fixed, const MotionEnds& ends, double margin = 0);

} // namespace chasles::culling
