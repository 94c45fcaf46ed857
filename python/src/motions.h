// Motions from arguments from Python.
#pragma once

#include "chasles/motion/motion.h"
#include "chasles/motion/own_trajectory.h"
#include "chasles/motion/timed_poses.h"
#include "python/src/poses.h"

#include <optional>
#include <variant>

namespace chasles::python {

/// A trajectory of the user's own and the motion along it.
struct OwnMotion {
    OwnTrajectory trajectory;
    Motion motion;

    operator Motion() const { return motion; } // NOLINT(google-explicit-constructor): like the other motions
};

/// A motion whose kind Python sees; the library's Motion hides it.
using TypedMotion =
    std::variant<ScrewMotion, SweepMotion, ConstantVelocity, ConstantTwist, TimedPoses, OwnMotion, Motion>;

/// The motion for a query.
Motion plain(const TypedMotion& motion);

/// The motion that an argument is. Throws InvalidInput if it is none.
TypedMotion given_motion(nb::handle motion);

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
