// The control maps of a screw and of a sweep without rounding, from the poses as they were given.
// Source: docs/derivations/12-exact-stage.md.
#pragma once

#include "chasles/algebra/exact_number.h"
#include "chasles/motion/control_maps.h"
#include "chasles/motion/motion_ends.h"

#include <memory>

namespace chasles::motion {

/// Control maps on [0, 1] over some positive unit. A sweep normalises its quaternion, which takes a square root.
struct ExactMotion {
    std::unique_ptr<const algebra::Dyadic> radicand; ///< of that root, to which the maps refer; null for a screw
    ControlMaps<algebra::ExactNumber> maps;
};

/// The screw between two poses, which must not be a half turn apart.
ExactMotion exact_screw(const MotionEnds& ends);

/// The sweep about a point of the moving body.
ExactMotion exact_sweep(const MotionEnds& ends, const Eigen::Vector3d& centre);

} // namespace chasles::motion
