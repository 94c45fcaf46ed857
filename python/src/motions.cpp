// chasles.ScrewMotion and chasles.SweepMotion.
#include "python/src/motions.h"

#include "chasles/base/invalid_input.h"
#include "python/src/bind.h"
#include "python/src/docstrings.h"

#include <fmt/format.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

namespace chasles::python {
namespace {

using namespace nb::literals;

#define CHASLES_POSE "numpy.typing.ArrayLike"
#define CHASLES_RELATIVE                                                                                               \
    "def relative(moving_start: " CHASLES_POSE ", moving_goal: " CHASLES_POSE ", fixed_start: " CHASLES_POSE           \
    ", fixed_goal: " CHASLES_POSE ") -> "

template <typename M>
constexpr const char* relative_signature =
    std::is_same_v<M, ScrewMotion> ? CHASLES_RELATIVE "ScrewMotion" : CHASLES_RELATIVE "SweepMotion";

void require_in_unit_interval(double number, const char* name) {
    if (!(number >= 0 && number <= 1))
        throw InvalidInput(fmt::format("{}: {} is not in [0, 1]", name, number));
}

template <typename M>
nb::object pose_at(const M& motion, double time) {
    require_in_unit_interval(time, "time");
    return matrix_of(motion.pose_at(time));
}

template <typename M>
M relative(nb::handle moving_start, nb::handle moving_goal, nb::handle fixed_start, nb::handle fixed_goal) {
    return M::relative(pose_from(moving_start, "moving_start"), pose_from(moving_goal, "moving_goal"),
                       pose_from(fixed_start, "fixed_start"), pose_from(fixed_goal, "fixed_goal"));
}

/// The poses and the centre that the motion was made from, for pickle.
template <typename M>
nb::tuple state(const M& motion) {
    const MotionEnds& ends = motion.ends();
    return nb::make_tuple(numbers_of(ends.given_start.pose), numbers_of(ends.given_goal.pose),
                          ends.fixed ? numbers_of(ends.fixed->start) : nb::none(),
                          ends.fixed ? numbers_of(ends.fixed->goal) : nb::none(),
                          ends.swept_centre ? array_of(*ends.swept_centre) : nb::none());
}

template <typename M>
M made_from(const nb::tuple& state) {
    if (state.size() != 5)
        throw InvalidInput(fmt::format("state: a motion has 5 parts, not {}", state.size()));
    M motion = state[2].is_none() ? M::between(pose_from(state[0], "start"), pose_from(state[1], "goal"))
                                  : relative<M>(state[0], state[1], state[2], state[3]);
    if constexpr (std::is_same_v<M, SweepMotion>)
        motion = motion.about(vector_from(state[4], "centre"));
    return motion;
}

/// Binds the members that both kinds of motion have.
template <typename M>
void bind_common(nb::class_<M>& type) {
    type.def_static("relative", relative<M>, "moving_start"_a, "moving_goal"_a, "fixed_start"_a, "fixed_goal"_a,
                    nb::sig(relative_signature<M>),
                    "For two moving bodies: the motion of one body in the frame of the other, which is called fixed. "
                    "All four poses are in the world, (4, 4) or (7,).")
        .def("pose_at", pose_at<M>, "time"_a, nb::sig("def pose_at(self, time: float) -> " CHASLES_ARRAY),
             "The pose (4, 4) of the moving body in the world at a time in [0, 1].")
        .def(
            "fixed_pose_at",
            [](const M& motion, double time) {
                require_in_unit_interval(time, "time");
                return matrix_of(motion.ends().fixed ? motion.ends().fixed_pose_at(time) : Pose());
            },
            "time"_a, nb::sig("def fixed_pose_at(self, time: float) -> " CHASLES_ARRAY),
            "The pose (4, 4) of the fixed body in the world at a time in [0, 1].")
        .def(
            "tau_at",
            [](const M& motion, double time) {
                require_in_unit_interval(time, "time");
                return motion.tau_at(time);
            },
            "time"_a, doc("ScrewMotion.tau_at"))
        .def(
            "time_at",
            [](const M& motion, double tau) {
                require_in_unit_interval(tau, "tau");
                return motion.time_at(tau);
            },
            "tau"_a, "The time that belongs to a tau: the inverse of tau_at().")
        .def_prop_ro("angle", &M::angle, doc("ScrewMotion.angle"))
        .def("__getstate__", state<M>)
        .def("__setstate__", [](M& motion, const nb::tuple& state) { new (&motion) M(made_from<M>(state)); });
}

std::string repr_of_screw(const ScrewMotion& motion) {
    return fmt::format("<chasles.ScrewMotion: turns {:.6g} rad about {} through {}, slides {:.6g}>", motion.angle(),
                       text_of(motion.axis_direction()), text_of(motion.axis_point()), motion.slide());
}

std::string repr_of_sweep(const SweepMotion& motion) {
    return fmt::format("<chasles.SweepMotion: turns {:.6g} rad, moves by {}>", motion.angle(),
                       text_of(motion.displacement()));
}

void bind_screw(nb::module_& module) {
    nb::class_<ScrewMotion> type(module, "ScrewMotion", doc("ScrewMotion"));
    type.def_static(
            "between",
            [](nb::handle start, nb::handle goal) {
                return ScrewMotion::between(pose_from(start, "start"), pose_from(goal, "goal"));
            },
            "start"_a, "goal"_a, nb::sig("def between(start: " CHASLES_POSE ", goal: " CHASLES_POSE ") -> ScrewMotion"),
            doc("ScrewMotion.between"))
        .def_prop_ro("slide", &ScrewMotion::slide, doc("ScrewMotion.slide"))
        .def_prop_ro(
            "axis_direction", [](const ScrewMotion& m) { return array_of(m.axis_direction()); },
            nb::sig("def axis_direction(self) -> " CHASLES_ARRAY), doc("ScrewMotion.axis_direction"))
        .def_prop_ro(
            "axis_point", [](const ScrewMotion& m) { return array_of(m.axis_point()); },
            nb::sig("def axis_point(self) -> " CHASLES_ARRAY), doc("ScrewMotion.axis_point"))
        .def("cut", &ScrewMotion::cut, "max_turn"_a, doc("ScrewMotion.cut"))
        .def("__repr__", repr_of_screw);
    bind_common(type);
}

void bind_sweep(nb::module_& module) {
    nb::class_<SweepMotion> type(module, "SweepMotion", doc("SweepMotion"));
    type.def_static(
            "between",
            [](nb::handle start, nb::handle goal, nb::handle centre) {
                const Pose from = pose_from(start, "start"), to = pose_from(goal, "goal");
                return centre.is_none() ? SweepMotion::between(from, to)
                                        : SweepMotion::between(from, to, vector_from(centre, "centre"));
            },
            "start"_a, "goal"_a, "centre"_a = nb::none(),
            nb::sig("def between(start: " CHASLES_POSE ", goal: " CHASLES_POSE ", centre: " CHASLES_POSE
                    " | None = None) -> SweepMotion"),
            doc("SweepMotion.between"))
        .def(
            "about", [](const SweepMotion& m, nb::handle centre) { return m.about(vector_from(centre, "centre")); },
            "centre"_a, nb::sig("def about(self, centre: " CHASLES_POSE ") -> SweepMotion"), doc("SweepMotion.about"))
        .def_prop_ro(
            "displacement", [](const SweepMotion& m) { return array_of(m.displacement()); },
            nb::sig("def displacement(self) -> " CHASLES_ARRAY), doc("SweepMotion.displacement"))
        .def("__repr__", repr_of_sweep);
    bind_common(type);
}

bool none_of(std::initializer_list<nb::handle> arguments) {
    for (const nb::handle argument : arguments)
        if (!argument.is_none())
            return false;
    return true;
}

Motion given_motion(nb::handle motion) {
    if (const ScrewMotion* screw = nullptr; nb::try_cast(motion, screw) && screw)
        return *screw;
    if (const SweepMotion* sweep = nullptr; nb::try_cast(motion, sweep) && sweep)
        return *sweep;
    throw InvalidInput("motion: must be a ScrewMotion or a SweepMotion");
}

} // namespace

Motion motion_from(const MotionArguments& a) {
    if (!a.motion.is_none()) {
        if (!none_of({a.start, a.goal, a.fixed_start, a.fixed_goal}))
            throw InvalidInput("motion: both a motion and poses are given; only one of them is allowed");
        return given_motion(a.motion);
    }
    if (a.start.is_none() || a.goal.is_none())
        throw InvalidInput("motion: start and goal are needed, or a motion");
    if (none_of({a.fixed_start, a.fixed_goal}))
        return ScrewMotion::between(pose_from(a.start, "start"), pose_from(a.goal, "goal"));
    if (a.fixed_start.is_none() || a.fixed_goal.is_none())
        throw InvalidInput("motion: fixed_start and fixed_goal are needed together");
    return ScrewMotion::relative(pose_from(a.start, "start"), pose_from(a.goal, "goal"),
                                 pose_from(a.fixed_start, "fixed_start"), pose_from(a.fixed_goal, "fixed_goal"));
}

void bind_motions(nb::module_& module) {
    bind_screw(module);
    bind_sweep(module);
}

} // namespace chasles::python
