// The motion of a question: one that is given, or one of a named kind between poses.
#include "chasles/base/invalid_input.h"
#include "python/src/bind.h"
#include "python/src/motions.h"
#include "python/src/names.h"
#include "python/src/recipe.h"
#include "view/names.h"

#include <fmt/format.h>

namespace chasles::python {
namespace {

bool none_of(std::initializer_list<nb::handle> arguments) {
    for (const nb::handle argument : arguments)
        if (!argument.is_none())
            return false;
    return true;
}

/// Start and goal of one body.
struct EndPoses {
    Pose start, goal;
};

/// Those of the fixed body, if it moves.
std::optional<EndPoses> fixed_poses_from(const MotionArguments& a) {
    if (none_of({a.fixed_start, a.fixed_goal}))
        return std::nullopt;
    if (a.fixed_start.is_none() || a.fixed_goal.is_none())
        throw InvalidInput("motion: fixed_start and fixed_goal are needed together");
    return EndPoses{pose_from(a.fixed_start, "fixed_start"), pose_from(a.fixed_goal, "fixed_goal")};
}

PythonScrew screw(const EndPoses& moving, const std::optional<EndPoses>& fixed, double max_turn) {
    if (!fixed)
        return {ScrewMotion::between(moving.start, moving.goal, max_turn)};
    return {ScrewMotion::relative(moving.start, moving.goal, fixed->start, fixed->goal, max_turn)};
}

SweepMotion sweep(const EndPoses& moving, const std::optional<EndPoses>& fixed) {
    return fixed ? SweepMotion::relative(moving.start, moving.goal, fixed->start, fixed->goal)
                 : SweepMotion::between(moving.start, moving.goal);
}

/// Even motions are motions in the world, each of one body.
template <typename Even>
TypedMotion even(const EndPoses& moving, const std::optional<EndPoses>& fixed) {
    const auto between = [](const EndPoses& ends) {
        return Between<Even>{Even::between(ends.start, ends.goal), ends.start, ends.goal};
    };
    if (!fixed)
        return between(moving);
    return made("relative", {}, {as_plain(between(moving)), as_plain(between(*fixed))});
}

/// The motion of this kind, about the bodies' origins.
TypedMotion motion_of_ends(view::MotionKind kind, const EndPoses& moving, const std::optional<EndPoses>& fixed,
                           double max_turn) {
    switch (kind) {
    case view::MotionKind::sweep:
        return sweep(moving, fixed);
    case view::MotionKind::velocity:
        return even<ConstantVelocity>(moving, fixed);
    case view::MotionKind::twist:
        return even<ConstantTwist>(moving, fixed);
    default:
        return screw(moving, fixed, max_turn);
    }
}

} // namespace

double max_turn_of(view::MotionKind kind, std::optional<double> given) {
    if (given && kind != view::MotionKind::screw)
        throw InvalidInput(
            fmt::format("max_turn: belongs to motion='screw', and the motion is '{}'", view::name_of(kind)));
    return given.value_or(ScrewMotion::default_max_turn);
}

TypedMotion motion_from(const MotionArguments& a) {
    const bool is_named = nb::isinstance<nb::str>(a.motion);
    if (!a.motion.is_none() && !is_named) {
        const TypedMotion given = given_motion(a.motion);
        if (!none_of({a.start, a.goal, a.fixed_start, a.fixed_goal}))
            throw InvalidInput("motion: both a motion and poses are given; only one of them is allowed. With poses, "
                               "the motion may be 'screw', 'sweep', 'velocity' or 'twist'");
        if (a.max_turn)
            throw InvalidInput("max_turn: belongs to the motion, which is given");
        return given;
    }
    const view::MotionKind kind = is_named ? kind_from(a.motion) : view::MotionKind::screw;
    if (a.start.is_none() || a.goal.is_none())
        throw InvalidInput("motion: start and goal are needed, or a motion by its name: motion=...");
    const double max_turn = max_turn_of(kind, a.max_turn);
    const EndPoses moving{pose_from(a.start, "start"), pose_from(a.goal, "goal")};
    return motion_of_ends(kind, moving, fixed_poses_from(a), max_turn);
}

TypedMotion motion_between(view::MotionKind kind, const Pose& start, const Pose& goal, std::optional<double> max_turn) {
    return motion_of_ends(kind, {start, goal}, std::nullopt, max_turn_of(kind, max_turn));
}

} // namespace chasles::python
