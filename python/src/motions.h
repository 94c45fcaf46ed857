// Motions from arguments from Python.
#pragma once

#include "chasles/motion/motion.h"
#include "python/src/poses.h"

namespace chasles::python {

/// The arguments of a query that describe the motion. Omitted arguments are None.
struct MotionArguments {
    nb::handle start;
    nb::handle goal;
    nb::handle motion;
    nb::handle fixed_start;
    nb::handle fixed_goal;
};

/// The motion if one is given, otherwise the screw from start to goal. If the fixed body has poses too, it is the screw
/// of the relative motion. Throws InvalidInput if arguments are missing or contradict each other.
Motion motion_from(const MotionArguments& arguments);

} // namespace chasles::python
