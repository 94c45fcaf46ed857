// Motions from arguments from Python.
#pragma once

#include "chasles/motion/motion.h"
#include "chasles/motion/own_trajectory.h"
#include "chasles/motion/timed_poses.h"
#include "python/src/owners.h"
#include "python/src/poses.h"
#include "view/motion_numbers.h"

#include <memory>
#include <optional>
#include <variant>

namespace chasles::python {

struct Recipe;

/// A motion of any kind, with the functions of Python that it follows.
struct PlainMotion {
    Motion motion;
    Owners owners = {};
    std::shared_ptr<const Recipe> recipe = {}; ///< how it was made; null for screws and sweeps

    operator Motion() const { return motion; } // NOLINT(google-explicit-constructor): like the other motions
};

/// A trajectory of the user's own and the motion along it.
struct OwnMotion : PlainMotion {
    OwnTrajectory trajectory;
};

/// A screw, which may be a piece of another one. For pickle: the poses of a piece are exact in the frame of the fixed
/// body only.
struct PythonScrew : ScrewMotion {
    std::shared_ptr<const PythonScrew> whole = {};
    std::size_t index = 0; ///< of the piece
};

/// An even motion with the poses that it was made of, for pickle.
template <class Even>
struct Between : Even {
    Pose start, goal;
};
using PythonVelocity = Between<ConstantVelocity>;
using PythonTwist = Between<ConstantTwist>;

/// A track that keeps its poses, for pickle.
struct PythonTrack : TimedPoses {
    std::shared_ptr<const Recipe> recipe;
};

/// A motion whose kind Python sees; the library's Motion hides it.
using TypedMotion =
    std::variant<PythonScrew, SweepMotion, PythonVelocity, PythonTwist, PythonTrack, OwnMotion, PlainMotion>;

/// The motion for a query.
Motion plain(const TypedMotion& motion);

/// The motion with its functions and its recipe.
PlainMotion as_plain(const TypedMotion& motion);

/// The trajectory of the user's own that the recipe tells of. Its functions must be one of the owners.
OwnMotion own_motion(const Recipe& recipe, const Owners& owners);

/// The functions of Python that the motion follows.
Owners owners_of(const TypedMotion& motion);

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
    nb::handle motion; ///< a motion, or the name of a kind
    nb::handle fixed_start;
    nb::handle fixed_goal;
    std::optional<double> max_turn = {}; ///< of a screw made of poses, radians
};

/// The largest turn of a piece of a screw: the given one, or the default. Throws InvalidInput if one is given for a
/// motion of another kind.
double max_turn_of(view::MotionKind kind, std::optional<double> given);

/// The motion if one is given. Otherwise that of the named kind (by default the screw) from start to goal. If the fixed
/// body has poses too, screws and sweeps are those of the relative motion, and other kinds move both bodies. Throws
/// InvalidInput if arguments are missing or contradict each other.
TypedMotion motion_from(const MotionArguments& arguments);

/// The motion of a kind between two poses, about the body's origin. Throws InvalidInput as max_turn_of.
TypedMotion motion_between(view::MotionKind kind, const Pose& start, const Pose& goal, std::optional<double> max_turn);

} // namespace chasles::python
