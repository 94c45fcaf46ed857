// Motions out of what Python hands over.
#pragma once

#include "chasles/motion/motion.h"
#include "python/src/poses.h"

namespace chasles::python {

/// The arguments of a query that say how the moving body moves; None where one is left out.
struct MotionArguments {
    nb::handle start;
    nb::handle goal;
    nb::handle motion;
    nb::handle fixed_start;
    nb::handle fixed_goal;
};

/// The motion if one is given; else the screw from start to goal, of two moving bodies if the fixed one has poses too.
/// Throws InvalidInput where arguments are missing or are too many.
Motion motion_from(const MotionArguments& arguments);

} // namespace chasles::python
