// Motions from arguments from Python.
#pragma once

#include "chasles/motion/motion.h"
#include "chasles/motion/own_trajectory.h"
#include "chasles/motion/timed_poses.h"
#include "python/src/owners.h"
#include "python/src/poses.h"

#include <optional>
#include <variant>

namespace chasles::python {

/// A motion of any kind, with the functions of Python that it follows.
struct PlainMotion {
    Motion motion;
    Owners owners = {};

    operator Motion() const { return motion; } // NOLINT(google-explicit-constructor): like the other motions
};

/// A trajectory of the user's own and the motion along it.
struct OwnMotion : PlainMotion {
    OwnTrajectory trajectory;
};

/// A motion whose kind Python sees; the library's Motion hides it.
using TypedMotion =
    std::variant<ScrewMotion, SweepMotion, ConstantVelocity, ConstantTwist, TimedPoses, OwnMotion, PlainMotion>;

/// The motion for a query.
Motion plain(const TypedMotion& motion);

/// The functions of Python that the motion follows.
Owners owners_of(const TypedMotion& motion);

/// A motion made of two others.
template <typename Make>
PlainMotion made_of(const TypedMotion& first, const TypedMotion& second, const Make& make) {
    return {make(plain(first), plain(second)), joined(owners_of(first), owners_of(second))};
}

template <typename Visit>
void for_each_reference(PlainMotion& motion, const Visit& visit) {
    for (nb::object& owner : motion.owners)
        visit(owner);
}

template <typename Visit>
void for_each_reference(TypedMotion& motion, const Visit& visit) {
    std::visit(
        [&](auto& typed) {
            if constexpr (requires { typed.owners; })
                for_each_reference(static_cast<PlainMotion&>(typed), visit);
        },
        motion);
}

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
