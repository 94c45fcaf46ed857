// A test with the largest nodes of both hierarchies. It proves that bodies stay clearly apart before the true motion is
// computed. Source: docs/derivations/23-coarse-motion.md.
#pragma once

#include "chasles/mesh/body.h"
#include "chasles/motion/any_trajectory.h"
#include "chasles/motion/coarse_motion.h"

namespace chasles::culling {

/// True if the surfaces are proven never to come within the margin on the whole trajectory, and neither body to be
/// inside of the other one. False proves nothing: the test gives up as soon as the bodies seem to be near each other.
bool are_clearly_apart(const Body& moving, const Body& fixed, const motion::AnyTrajectory& trajectory,
                       double margin = 0);
/// Likewise for one coarse motion, within whose deviation the true motion stays.
bool are_clearly_apart(const Body& moving, const Body& fixed, const motion::CoarseMotion& motion, double margin);

} // namespace chasles::culling
