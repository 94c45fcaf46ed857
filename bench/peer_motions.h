// What libraries in other processes do between two poses.
#pragma once

#include "bench/peer.h"

namespace chasles::bench {

/// The screw at constant rates.
Eigen::Isometry3d on_uniform_screw(const Displacement& motion, double time);

/// On a straight line with the orientation of the start: the goal's is ignored.
Eigen::Isometry3d without_turning(const Displacement& motion, double time);

} // namespace chasles::bench
