// A trajectory of the user's own as a frame. Source: docs/derivations/26-frames.md, "The user's own".
#pragma once

#include "chasles/motion/moving_frame.h"
#include "chasles/motion/own_trajectory.h"

namespace chasles::motion {

/// The frame of the trajectory. Throws InvalidInput if it cannot be used.
SharedFrame own_frame(const OwnTrajectory& trajectory);

/// The bounds of an interval. Throws InvalidInput for a bound that is negative or NaN.
MotionBounds checked_bounds(const OwnTrajectory& trajectory, double from, double to);

} // namespace chasles::motion
