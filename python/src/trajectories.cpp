// The motions that are no rational ones, and trajectories of the user's own.
#include "chasles/base/invalid_input.h"
#include "chasles/motion/own_trajectory.h"
#include "python/src/bind.h"
#include "python/src/docstrings.h"
#include "python/src/motions.h"
#include "python/src/no_constructor.h"
#include "python/src/recipe.h"

#include <fmt/format.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

namespace chasles::python {
namespace {

using namespace nb::literals;

#define CHASLES_POSE "numpy.typing.ArrayLike"
#define CHASLES_MOTIONS "Motion | ConstantVelocity | ConstantTwist | TimedPoses | Trajectory"

Eigen::Vector3d centre_from(nb::handle centre) {
    return centre.is_none() ? Eigen::Vector3d::Zero() : vector_from(centre, "centre");
}

/// A form of the coefficients of a polynomial in the time.
constexpr const char* in_time = "[0, 0.5], which goes evenly from 0 to 0.5";

/// Numbers from any sequence of them. A message shows the form.
std::vector<double> numbers_from(nb::handle argument, const char* name, const char* form) {
    std::vector<double> numbers;
    if (!nb::try_cast(argument, numbers))
        throw InvalidInput(fmt::format("{}: {} is no sequence of numbers; one is needed, as in {}", name,
                                       text_of_argument(argument), form));
    return numbers;
}

std::vector<Eigen::Vector3d> vectors_from(nb::handle argument, const char* name) {
    if (!nb::isinstance<nb::iterable>(argument))
        throw InvalidInput(fmt::format("{}: {} is no list of points; one is needed, as in [[0, 0, 0], [1, 0, 0]]", name,
                                       text_of_argument(argument)));
    std::vector<Eigen::Vector3d> vectors;
    for (const nb::handle item : argument)
        vectors.push_back(vector_from(item, fmt::format("{}[{}]", name, vectors.size())));
    return vectors;
}

PlainMotion product(const TypedMotion& outer, const TypedMotion& inner) {
    return made("product", {}, {as_plain(outer), as_plain(inner)});
}

double in_unit_interval(double time) {
    if (!(time >= 0 && time <= 1))
        throw InvalidInput(fmt::format("time: {} is not in [0, 1]", time));
    return time;
}

/// Members that all kinds of motion have.
template <typename M>
void bind_poses(nb::class_<M>& type) {
    type.def(
            "pose_at", [](const M& m, double time) { return matrix_of(plain(m).pose_at(in_unit_interval(time))); },
            "time"_a, nb::sig("def pose_at(self, time: float) -> " CHASLES_ARRAY),
            "The pose (4, 4) of the moving body in the world at a time in [0, 1].")
        .def(
            "fixed_pose_at",
            [](const M& m, double time) { return matrix_of(plain(m).fixed_pose_at(in_unit_interval(time))); }, "time"_a,
            nb::sig("def fixed_pose_at(self, time: float) -> " CHASLES_ARRAY),
            "The pose (4, 4) of the fixed body in the world at a time in [0, 1].")
        .def(
            "reversed", [](const M& m) { return made("reversed", {}, {as_plain(m)}); },
            nb::sig("def reversed(self) -> Motion"), doc("Motion.reversed"))
        .def(
            "__mul__", [](const M& outer, nb::handle inner) { return product(outer, given_motion(inner)); },
            "inner"_a.none(), nb::sig("def __mul__(self, inner: " CHASLES_MOTIONS ") -> Motion"),
            "The motion `inner`, carried by this one: its pose is self.pose_at(t) @ inner.pose_at(t).");
}

void bind_motion(nb::module_& module) {
    nb::class_<PlainMotion> type(module, "Motion", doc("Motion"), collected<PlainMotion>());
    refuse_constructor(type, "Motion.at_rest(pose), Motion.hinge, Motion.slider and Motion.polynomial make one");
    type.def_static(
            "at_rest", [](nb::handle pose) { return made("rest", {listed(pose_from(pose, "pose"))}); }, "pose"_a.none(),
            nb::sig("def at_rest(pose: " CHASLES_POSE ") -> Motion"), doc("Motion.at_rest"))
        .def_static(
            "hinge",
            [](nb::handle point, nb::handle direction, nb::handle angle) {
                return made("hinge", {listed(vector_from(point, "point")), listed(vector_from(direction, "direction")),
                                      numbers_from(angle, "angle", in_time)});
            },
            "point"_a.none(), "direction"_a.none(), "angle"_a.none(),
            nb::sig("def hinge(point: " CHASLES_POSE ", direction: " CHASLES_POSE
                    ", angle: collections.abc.Sequence[float]) -> Motion"),
            doc("Motion.hinge"))
        .def_static(
            "slider",
            [](nb::handle direction, nb::handle way) {
                return made("slider", {listed(vector_from(direction, "direction")), numbers_from(way, "way", in_time)});
            },
            "direction"_a.none(), "way"_a.none(),
            nb::sig("def slider(direction: " CHASLES_POSE ", way: collections.abc.Sequence[float]) -> Motion"),
            doc("Motion.slider"))
        .def_static(
            "polynomial",
            [](nb::handle places) { return made("polynomial", {listed(vectors_from(places, "places"))}); },
            "places"_a.none(), nb::sig("def polynomial(places: " CHASLES_POSE ") -> Motion"), doc("Motion.polynomial"))
        .def("__getstate__", [](const PlainMotion& motion) { return state_of(motion); })
        .def("__setstate__",
             [](PlainMotion& motion, const nb::tuple& state) { new (&motion) PlainMotion(motion_of_state(state)); })
        .def("__repr__", [](const PlainMotion&) { return "<chasles.Motion>"; });
    bind_poses(type);
    module.def(
        "rest_of",
        [](nb::handle motion, double start) { return made("rest of", {{start}}, {as_plain(given_motion(motion))}); },
        "motion"_a.none(), "start"_a, nb::sig("def rest_of(motion: " CHASLES_MOTIONS ", start: float) -> Motion"),
        doc("rest_of"));
    module.def(
        "relative",
        [](nb::handle moving, nb::handle fixed) {
            return made("relative", {}, {as_plain(given_motion(moving)), as_plain(given_motion(fixed))});
        },
        "moving"_a.none(), "fixed"_a.none(),
        nb::sig("def relative(moving: " CHASLES_MOTIONS ", fixed: " CHASLES_MOTIONS ") -> Motion"), doc("relative"));
}

PythonVelocity velocity_between(const Pose& start, const Pose& goal, const Eigen::Vector3d& centre) {
    return {ConstantVelocity::between(start, goal, centre), start, goal};
}

PythonTwist twist_between(const Pose& start, const Pose& goal) {
    return {ConstantTwist::between(start, goal), start, goal};
}

void require_parts(const nb::tuple& state, std::size_t parts) {
    if (state.size() != parts)
        throw InvalidInput(fmt::format("state: this motion has {} parts, not {}", parts, state.size()));
}

void bind_even(nb::module_& module) {
    nb::class_<PythonVelocity> velocity(module, "ConstantVelocity", doc("ConstantVelocity"));
    refuse_constructor(velocity, "ConstantVelocity.between(start, goal) makes one");
    velocity
        .def_static(
            "between",
            [](nb::handle start, nb::handle goal, nb::handle centre) {
                return velocity_between(pose_from(start, "start"), pose_from(goal, "goal"), centre_from(centre));
            },
            "start"_a.none(), "goal"_a.none(), "centre"_a = nb::none(),
            nb::sig("def between(start: " CHASLES_POSE ", goal: " CHASLES_POSE ", centre: " CHASLES_POSE
                    " | None = None) -> ConstantVelocity"),
            doc("ConstantVelocity.between"))
        .def_prop_ro("angle", &ConstantVelocity::angle, doc("ConstantVelocity.angle"))
        .def_prop_ro(
            "displacement", [](const PythonVelocity& m) { return array_of(m.displacement()); },
            nb::sig("def displacement(self) -> " CHASLES_ARRAY), doc("ConstantVelocity.displacement"))
        .def_prop_ro(
            "centre", [](const PythonVelocity& m) { return array_of(m.centre()); },
            nb::sig("def centre(self) -> " CHASLES_ARRAY), doc("ConstantVelocity.centre"))
        .def("__repr__",
             [](const PythonVelocity& m) {
                 return fmt::format("<chasles.ConstantVelocity: turns {:.6g} rad, moves by {}>", m.angle(),
                                    text_of(m.displacement()));
             })
        .def("__getstate__",
             [](const PythonVelocity& m) {
                 return nb::make_tuple(numbers_of(m.start), numbers_of(m.goal), array_of(m.centre()));
             })
        .def("__setstate__", [](PythonVelocity& m, const nb::tuple& state) {
            require_parts(state, 3);
            new (&m) PythonVelocity(velocity_between(pose_from(state[0], "start"), pose_from(state[1], "goal"),
                                                     vector_from(state[2], "centre")));
        });
    bind_poses(velocity);

    nb::class_<PythonTwist> twist(module, "ConstantTwist", doc("ConstantTwist"));
    refuse_constructor(twist, "ConstantTwist.between(start, goal) makes one");
    twist
        .def_static(
            "between",
            [](nb::handle start, nb::handle goal) {
                return twist_between(pose_from(start, "start"), pose_from(goal, "goal"));
            },
            "start"_a.none(), "goal"_a.none(),
            nb::sig("def between(start: " CHASLES_POSE ", goal: " CHASLES_POSE ") -> ConstantTwist"),
            doc("ConstantTwist.between"))
        .def_prop_ro(
            "screw_of_same_poses", [](const PythonTwist& m) { return PythonScrew{m.screw_of_same_poses()}; },
            doc("ConstantTwist.screw_of_same_poses"))
        .def("__repr__",
             [](const PythonTwist& m) {
                 const ScrewMotion screw = m.screw_of_same_poses();
                 return fmt::format("<chasles.ConstantTwist: turns {:.6g} rad about {}, slides {:.6g}>", screw.angle(),
                                    text_of(screw.axis_direction()), screw.slide());
             })
        .def("__getstate__",
             [](const PythonTwist& m) { return nb::make_tuple(numbers_of(m.start), numbers_of(m.goal)); })
        .def("__setstate__", [](PythonTwist& m, const nb::tuple& state) {
            require_parts(state, 2);
            new (&m) PythonTwist(twist_between(pose_from(state[0], "start"), pose_from(state[1], "goal")));
        });
    bind_poses(twist);
}

PythonTrack track_from(Numbers numbers) {
    TimedPoses track = track_of(numbers);
    return {std::move(track), std::make_shared<const Recipe>("track", std::move(numbers))};
}

PythonTrack timed_poses(nb::handle stamps, nb::handle poses, const std::string& between, nb::handle centre) {
    if (between != "velocity" && between != "twist")
        throw InvalidInput(fmt::format("between: must be \"velocity\" or \"twist\", not \"{}\"", between));
    return track_from({numbers_from(stamps, "stamps", "[0, 0.5, 1]"),
                       listed(poses_from(poses, "poses")),
                       {between == "twist" ? 1.0 : 0.0},
                       listed(centre_from(centre))});
}

void set_track_state(PythonTrack& track, const nb::tuple& state) {
    const PlainMotion motion = motion_of_state(state);
    if (motion.recipe->maker != "track")
        throw InvalidInput("state: is not that of a track");
    new (&track) PythonTrack(track_from(motion.recipe->numbers));
}

void bind_tracks(nb::module_& module) {
    nb::class_<PythonTrack> track(module, "TimedPoses", doc("TimedPoses"));
    refuse_constructor(track, "TimedPoses.through(stamps, poses) makes one");
    track
        .def_static("through", timed_poses, "stamps"_a.none(), "poses"_a.none(), "between"_a = "velocity",
                    "centre"_a = nb::none(),
                    nb::sig("def through(stamps: collections.abc.Sequence[float], poses: " CHASLES_POSE
                            ", between: typing.Literal['velocity', 'twist'] = 'velocity', centre: " CHASLES_POSE
                            " | None = None) -> TimedPoses"),
                    doc("TimedPoses.through"))
        .def_prop_ro("stamps", &TimedPoses::stamps, "The time stamps.")
        .def("__getstate__", [](const PythonTrack& m) { return state_of(as_plain(m)); })
        .def("__setstate__", set_track_state)
        .def(
            "stamp_of",
            [](const PythonTrack& m, double lower, double upper) {
                const Bracket stamp = m.stamp_of({in_unit_interval(lower), in_unit_interval(upper)});
                return std::pair(stamp.lower, stamp.upper);
            },
            "time"_a, "time_upper"_a, doc("TimedPoses.stamp_of"))
        .def("time_of", &TimedPoses::time_of, "stamp"_a, doc("TimedPoses.time_of"))
        .def("segment_of", &TimedPoses::segment_of, "time"_a, doc("TimedPoses.segment_of"))
        .def("__repr__", [](const PythonTrack& m) {
            return fmt::format("<chasles.TimedPoses: {} poses from {:.6g} to {:.6g}>", m.stamps().size(),
                               m.stamps().front(), m.stamps().back());
        });
    bind_poses(track);

    struct Spline {};
    nb::class_<Spline> spline(module, "Spline", "Motions along splines.");
    refuse_constructor(spline, "Spline.through(times, poses) and Spline.b_spline(poses) make motions");
    spline
        .def_static(
            "through",
            [](nb::handle times, nb::handle poses) {
                return made("spline",
                            {numbers_from(times, "times", "[0, 0.5, 1]"), listed(poses_from(poses, "poses"))});
            },
            "times"_a.none(), "poses"_a.none(),
            nb::sig("def through(times: collections.abc.Sequence[float], poses: " CHASLES_POSE ") -> Motion"),
            doc("Motion.spline"))
        .def_static(
            "b_spline", [](nb::handle poses) { return made("b spline", {listed(poses_from(poses, "poses"))}); },
            "poses"_a.none(), nb::sig("def b_spline(poses: " CHASLES_POSE ") -> Motion"), doc("Motion.b_spline"));
}

} // namespace

void bind_trajectories(nb::module_& module) {
    bind_motion(module);
    bind_even(module);
    bind_tracks(module);
}

} // namespace chasles::python
