// Splines of positions and orientations as frames. Source: docs/derivations/26-frames.md, "Splines".
#pragma once

#include "chasles/motion/moving_frame.h"
#include "chasles/motion/timed_poses.h"

#include <span>

namespace chasles::motion {

/// Even motions from pose to pose; a velocity has the body point `centre` on straight lines. Times ascend from 0 to 1.
SharedFrame even_track(std::vector<double> times, std::span<const Pose> poses, TimedPoses::Between kind,
                       const Eigen::Vector3d& centre);

/// The body's origin on the natural cubic spline through all positions, with slerp from orientation to orientation.
SharedFrame natural_spline(const std::vector<double>& times, std::span<const Pose> poses);

/// The uniform cumulative cubic B-spline, whose first and last control pose count three times.
SharedFrame cumulative_b_spline(std::span<const Pose> poses);

/// Throws InvalidInput unless there are at least two poses and as many times, which ascend from 0 to 1.
void require_track(std::span<const double> times, std::span<const Pose> poses);

} // namespace chasles::motion
