// The motions that are no rational ones, and trajectories of the user's own.
#include "chasles/base/invalid_input.h"
#include "chasles/motion/own_trajectory.h"
#include "python/src/bind.h"
#include "python/src/docstrings.h"
#include "python/src/motions.h"

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
    return made_of(outer, inner, [](const Motion& a, const Motion& b) { return a * b; });
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
            "__mul__", [](const M& outer, nb::handle inner) { return product(outer, given_motion(inner)); },
            "inner"_a.none(), nb::sig("def __mul__(self, inner: " CHASLES_MOTIONS ") -> Motion"),
            "The motion `inner`, carried by this one: its pose is self.pose_at(t) @ inner.pose_at(t).");
}

void bind_motion(nb::module_& module) {
    nb::class_<PlainMotion> type(module, "Motion", doc("Motion"), collected<PlainMotion>());
    type.def_static(
            "at_rest", [](nb::handle pose) { return PlainMotion{Motion::at_rest(pose_from(pose, "pose"))}; },
            "pose"_a.none(), nb::sig("def at_rest(pose: " CHASLES_POSE ") -> Motion"), doc("Motion.at_rest"))
        .def_static(
            "hinge",
            [](nb::handle point, nb::handle direction, nb::handle angle) {
                return PlainMotion{Motion::hinge(vector_from(point, "point"), vector_from(direction, "direction"),
                                                 numbers_from(angle, "angle", in_time))};
            },
            "point"_a.none(), "direction"_a.none(), "angle"_a.none(),
            nb::sig("def hinge(point: " CHASLES_POSE ", direction: " CHASLES_POSE
                    ", angle: collections.abc.Sequence[float]) -> Motion"),
            doc("Motion.hinge"))
        .def_static(
            "slider",
            [](nb::handle direction, nb::handle way) {
                return PlainMotion{
                    Motion::slider(vector_from(direction, "direction"), numbers_from(way, "way", in_time))};
            },
            "direction"_a.none(), "way"_a.none(),
            nb::sig("def slider(direction: " CHASLES_POSE ", way: collections.abc.Sequence[float]) -> Motion"),
            doc("Motion.slider"))
        .def_static(
            "polynomial",
            [](nb::handle places) { return PlainMotion{Motion::polynomial(vectors_from(places, "places"))}; },
            "places"_a.none(), nb::sig("def polynomial(places: " CHASLES_POSE ") -> Motion"), doc("Motion.polynomial"))
        .def("__repr__", [](const PlainMotion&) { return "<chasles.Motion>"; });
    bind_poses(type);
    module.def(
        "rest_of",
        [](nb::handle motion, double start) {
            const TypedMotion whole = given_motion(motion);
            return PlainMotion{rest_of(plain(whole), start), owners_of(whole)};
        },
        "motion"_a.none(), "start"_a, nb::sig("def rest_of(motion: " CHASLES_MOTIONS ", start: float) -> Motion"),
        doc("rest_of"));
    module.def(
        "relative",
        [](nb::handle moving, nb::handle fixed) {
            return made_of(given_motion(moving), given_motion(fixed),
                           [](const Motion& a, const Motion& b) { return relative(a, b); });
        },
        "moving"_a.none(), "fixed"_a.none(),
        nb::sig("def relative(moving: " CHASLES_MOTIONS ", fixed: " CHASLES_MOTIONS ") -> Motion"), doc("relative"));
}

void bind_even(nb::module_& module) {
    nb::class_<ConstantVelocity> velocity(module, "ConstantVelocity", doc("ConstantVelocity"));
    velocity
        .def_static(
            "between",
            [](nb::handle start, nb::handle goal, nb::handle centre) {
                return ConstantVelocity::between(pose_from(start, "start"), pose_from(goal, "goal"),
                                                 centre_from(centre));
            },
            "start"_a.none(), "goal"_a.none(), "centre"_a = nb::none(),
            nb::sig("def between(start: " CHASLES_POSE ", goal: " CHASLES_POSE ", centre: " CHASLES_POSE
                    " | None = None) -> ConstantVelocity"),
            doc("ConstantVelocity.between"))
        .def_prop_ro("angle", &ConstantVelocity::angle, doc("ConstantVelocity.angle"))
        .def_prop_ro(
            "displacement", [](const ConstantVelocity& m) { return array_of(m.displacement()); },
            nb::sig("def displacement(self) -> " CHASLES_ARRAY), doc("ConstantVelocity.displacement"))
        .def_prop_ro(
            "centre", [](const ConstantVelocity& m) { return array_of(m.centre()); },
            nb::sig("def centre(self) -> " CHASLES_ARRAY), doc("ConstantVelocity.centre"))
        .def("__repr__",
             [](const ConstantVelocity& m) {
                 return fmt::format("<chasles.ConstantVelocity: turns {:.6g} rad, moves by {}>", m.angle(),
                                    text_of(m.displacement()));
             })
        .def("__getstate__",
             [](const ConstantVelocity& m) {
                 return nb::make_tuple(numbers_of(m.pose_at(0)), numbers_of(m.pose_at(1)), array_of(m.centre()));
             })
        .def("__setstate__", [](ConstantVelocity& m, const nb::tuple& state) {
            new (&m) ConstantVelocity(ConstantVelocity::between(
                pose_from(state[0], "start"), pose_from(state[1], "goal"), vector_from(state[2], "centre")));
        });
    bind_poses(velocity);

    nb::class_<ConstantTwist> twist(module, "ConstantTwist", doc("ConstantTwist"));
    twist
        .def_static(
            "between",
            [](nb::handle start, nb::handle goal) {
                return ConstantTwist::between(pose_from(start, "start"), pose_from(goal, "goal"));
            },
            "start"_a.none(), "goal"_a.none(),
            nb::sig("def between(start: " CHASLES_POSE ", goal: " CHASLES_POSE ") -> ConstantTwist"),
            doc("ConstantTwist.between"))
        .def_prop_ro("screw_of_same_poses", &ConstantTwist::screw_of_same_poses,
                     doc("ConstantTwist.screw_of_same_poses"))
        .def("__repr__",
             [](const ConstantTwist& m) {
                 const ScrewMotion screw = m.screw_of_same_poses();
                 return fmt::format("<chasles.ConstantTwist: turns {:.6g} rad about {}, slides {:.6g}>", screw.angle(),
                                    text_of(screw.axis_direction()), screw.slide());
             })
        .def("__getstate__",
             [](const ConstantTwist& m) { return nb::make_tuple(numbers_of(m.pose_at(0)), numbers_of(m.pose_at(1))); })
        .def("__setstate__", [](ConstantTwist& m, const nb::tuple& state) {
            new (&m) ConstantTwist(ConstantTwist::between(pose_from(state[0], "start"), pose_from(state[1], "goal")));
        });
    bind_poses(twist);
}

TimedPoses timed_poses(nb::handle stamps, nb::handle poses, const std::string& between, nb::handle centre) {
    if (between != "velocity" && between != "twist")
        throw InvalidInput(fmt::format("between: must be \"velocity\" or \"twist\", not \"{}\"", between));
    return TimedPoses::through(numbers_from(stamps, "stamps", "[0, 0.5, 1]"), poses_from(poses, "poses"),
                               between == "twist" ? TimedPoses::Between::twist : TimedPoses::Between::velocity,
                               centre_from(centre));
}

void bind_tracks(nb::module_& module) {
    nb::class_<TimedPoses> track(module, "TimedPoses", doc("TimedPoses"));
    track
        .def_static("through", timed_poses, "stamps"_a.none(), "poses"_a.none(), "between"_a = "velocity",
                    "centre"_a = nb::none(),
                    nb::sig("def through(stamps: collections.abc.Sequence[float], poses: " CHASLES_POSE
                            ", between: typing.Literal['velocity', 'twist'] = 'velocity', centre: " CHASLES_POSE
                            " | None = None) -> TimedPoses"),
                    doc("TimedPoses.through"))
        .def_prop_ro("stamps", &TimedPoses::stamps, "The time stamps.")
        .def(
            "stamp_of",
            [](const TimedPoses& m, double lower, double upper) {
                const Bracket stamp = m.stamp_of({in_unit_interval(lower), in_unit_interval(upper)});
                return std::pair(stamp.lower, stamp.upper);
            },
            "time"_a, "time_upper"_a, doc("TimedPoses.stamp_of"))
        .def("time_of", &TimedPoses::time_of, "stamp"_a, doc("TimedPoses.time_of"))
        .def("segment_of", &TimedPoses::segment_of, "time"_a, doc("TimedPoses.segment_of"))
        .def("__repr__", [](const TimedPoses& m) {
            return fmt::format("<chasles.TimedPoses: {} poses from {:.6g} to {:.6g}>", m.stamps().size(),
                               m.stamps().front(), m.stamps().back());
        });
    bind_poses(track);

    struct Spline {};
    nb::class_<Spline>(module, "Spline", "Motions along splines.")
        .def_static(
            "through",
            [](nb::handle times, nb::handle poses) {
                return PlainMotion{
                    Motion::spline(numbers_from(times, "times", "[0, 0.5, 1]"), poses_from(poses, "poses"))};
            },
            "times"_a.none(), "poses"_a.none(),
            nb::sig("def through(times: collections.abc.Sequence[float], poses: " CHASLES_POSE ") -> Motion"),
            doc("Motion.spline"))
        .def_static(
            "b_spline", [](nb::handle poses) { return PlainMotion{Motion::b_spline(poses_from(poses, "poses"))}; },
            "poses"_a.none(), nb::sig("def b_spline(poses: " CHASLES_POSE ") -> Motion"), doc("Motion.b_spline"));
}

} // namespace

void bind_trajectories(nb::module_& module) {
    bind_motion(module);
    bind_even(module);
    bind_tracks(module);
}

} // namespace chasles::python
