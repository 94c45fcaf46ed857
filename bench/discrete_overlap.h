// A discrete test: whether two triangle surfaces pass through each other at one pose. It is independent of the
// library's detections and hierarchies, and computes in plain double precision. It is a check, not a proof.
#pragma once

#include "chasles/mesh/polyhedron.h"

#include <Eigen/Geometry>

namespace chasles::bench {

/// `pose` is the pose of the moving body in the frame of the fixed body. All faces must be convex.
bool is_overlapping(const Polyhedron& moving, const Polyhedron& fixed, const Eigen::Isometry3d& pose);

} // namespace chasles::bench
