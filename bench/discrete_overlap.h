// Do two surfaces of triangles pass through each other at one pose? Independent of the library's own detections and
// hierarchies, in plain double precision: a check, not a proof.
#pragma once

#include "chasles/mesh/polyhedron.h"

#include <Eigen/Geometry>

namespace chasles::bench {

/// `pose` takes the moving body into the frame of the fixed one. Convex faces only.
bool is_overlapping(const Polyhedron& moving, const Polyhedron& fixed, const Eigen::Isometry3d& pose);

} // namespace chasles::bench
