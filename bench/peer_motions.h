// The motions of libraries in other processes between two poses.
#pragma once

#include "bench/peer.h"

namespace chasles::bench {

/// The screw with constant rates of turn and slide.
Eigen::Isometry3d on_uniform_screw(const Displacement& motion, double time);

/// A straight line with the orientation of the start. The orientation of the goal is ignored.
Eigen::Isometry3d without_turning(const Displacement& motion, double time);

} // namespace chasles::bench
