// The control maps of a motion without rounding, from the poses as they were given.
// Source: docs/derivations/12-exact-stage.md.
#pragma once

#include "chasles/algebra/exact_number.h"
#include "chasles/motion/control_maps.h"
#include "chasles/motion/motion_ends.h"

#include <memory>

namespace chasles::motion {

/// Control maps on [0, 1] over some positive unit. A sweep's quaternion has length one, which takes a square root.
struct ExactMotion {
    std::unique_ptr<const algebra::Dyadic> radicand; ///< of that root, to which the maps refer
    ControlMaps<algebra::ExactNumber> maps;
};

ExactMotion exact_motion(const MotionFrame& frame);

} // namespace chasles::motion
