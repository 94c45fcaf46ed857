// Motions from arguments from Python.
#pragma once

#include "chasles/motion/motion.h"
#include "python/src/poses.h"

#include <optional>
#include <variant>

namespace chasles::python {

/// A motion whose kind Python sees; the library's Motion hides it.
using TypedMotion = std::variant<ScrewMotion, SweepMotion>;

/// The motion for a query.
Motion plain(const TypedMotion& motion);

/// The arguments of a query that describe the motion. Omitted arguments are None.
struct MotionArguments {
    nb::handle start;
    nb::handle goal;
    nb::handle motion;
    nb::handle fixed_start;
    nb::handle fixed_goal;
    std::optional<double> max_turn = {}; ///< of a screw made of poses, radians
};

/// The motion if one is given, otherwise the screw from start to goal. If the fixed body has poses too, it is the screw
/// of the relative motion. Throws InvalidInput if arguments are missing or contradict each other.
TypedMotion motion_from(const MotionArguments& arguments);

} // namespace chasles::python
