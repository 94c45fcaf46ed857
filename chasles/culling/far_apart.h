// A test with one ball around each body. It proves before any other work that a whole motion keeps the bodies apart.
// Source: docs/derivations/07-swept-boxes.md, "Far apart".
#pragma once

#include "chasles/mesh/body.h"
#include "chasles/motion/any_trajectory.h"

namespace chasles::culling {

/// True if the bodies are proven never to come within the margin on the whole trajectory. False proves nothing.
bool are_far_apart(const Body& moving, const Body& fixed, const motion::AnyTrajectory& trajectory, double margin = 0);

} // namespace chasles::culling
