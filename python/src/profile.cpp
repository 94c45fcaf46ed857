// chasles.DistanceProfile and chasles.profile.
#include "python/src/profile.h"

#include "chasles/query/profile.h"
#include "python/src/arrays.h"
#include "python/src/bind.h"
#include "python/src/body.h"
#include "python/src/docstrings.h"
#include "python/src/interruptible.h"
#include "python/src/motions.h"
#include "python/src/query_options.h"
#include "python/src/signals.h"
#include "python/src/without_gil.h"

#include <algorithm>
#include <fmt/format.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

namespace chasles::python {
namespace {

using namespace nb::literals;

/// A profile of two bodies, or of the named pairs of a scene or a robot.
struct PythonProfile {
    DistanceProfile found;
    std::vector<Names> pairs; ///< what `found.nearest` counts
    std::optional<UntestedPairs> untested;
};

using Intervals = std::vector<std::pair<double, double>>;

Intervals intervals_of(const std::vector<Bracket>& parts) {
    Intervals intervals;
    for (const Bracket& part : parts)
        intervals.emplace_back(part.lower, part.upper);
    return intervals;
}

ProfileOptions options_from(double tolerance, double absolute_tolerance, nb::handle margins, double time_tolerance) {
    ProfileOptions options{.tolerance = tolerance,
                           .absolute_tolerance = absolute_tolerance,
                           .margins = {},
                           .time_tolerance = time_tolerance};
    const DoubleArray numbers(margins, "margins");
    options.margins.assign(numbers.numbers().begin(), numbers.numbers().end());
    return options;
}

PythonProfile ask(nb::handle moving, nb::handle fixed, nb::handle start, nb::handle goal, nb::handle motion,
                  nb::handle fixed_start, nb::handle fixed_goal, double tolerance, double absolute_tolerance,
                  nb::handle margins, double time_tolerance, std::optional<double> max_turn) {
    const Polyhedron& moving_body = polyhedron_of(moving, "moving");
    const Polyhedron& fixed_body = polyhedron_of(fixed, "fixed");
    const TypedMotion typed = motion_from({start, goal, motion, fixed_start, fixed_goal, max_turn});
    const ProfileOptions options = options_from(tolerance, absolute_tolerance, margins, time_tolerance);
    const WithoutGil without_gil;
    const EndsBySignals ends_by_signals;
    return {profile({moving_body, fixed_body, plain(typed), options}), {}, {}};
}

std::string options_doc() {
    return "tolerance : float\n" + indented(doc("ProfileOptions.tolerance")) + "absolute_tolerance : float\n" +
           indented(doc("ProfileOptions.absolute_tolerance")) + "margins : array_like of floats\n" +
           indented(doc("ProfileOptions.margins")) + "time_tolerance : float\n" +
           indented(doc("ProfileOptions.time_tolerance"));
}

std::string profile_doc() {
    return "How far apart are two polyhedra over a motion? Bounds of their distance, proven for every time.\n\n" +
           motion_docs() + options_doc() + max_turn_docs +
           "\nReturns\n-------\nDistanceProfile\n    `times`, `lower` and `upper`; `zones` and `free`.\n\n" +
           invalid_input_docs;
}

PythonProfile profile_of_scene(const PythonScene& given, double tolerance, double absolute_tolerance,
                               nb::handle margins, double time_tolerance) {
    const Asking question = given.asking();
    const ProfileOptions options = options_from(tolerance, absolute_tolerance, margins, time_tolerance);
    SceneProfile answer;
    run_interruptibly([&](Progress&) { answer = given.scene.profile(options); }, nb::none());
    PythonProfile profile{std::move(answer.distance), {}, given.scene.untested()};
    for (const auto& [moving, fixed] : answer.pairs)
        profile.pairs.emplace_back(given.scene.bodies()[moving].name, given.scene.bodies()[fixed].name);
    return profile;
}

PythonProfile profile_of_robot(const RobotChecker& checker, const PathArguments& arguments, double tolerance,
                               double absolute_tolerance, nb::handle margins, double time_tolerance) {
    const ProfileOptions options = options_from(tolerance, absolute_tolerance, margins, time_tolerance);
    const JointPath path = path_from(checker.robot(), arguments);
    const std::vector<Handover> handovers = handovers_from(arguments);
    RobotProfile answer = asked([&] { return checker.profile(path, options, handovers); });
    PythonProfile profile{std::move(answer.distance), {}, *answer.untested};
    for (const RobotPair& pair : answer.pairs)
        profile.pairs.emplace_back(pair.first, pair.second);
    return profile;
}

std::string scene_profile_doc() {
    return "The distance of the two bodies that are nearest over the time, and which two. Margins of the scene have no "
           "effect, and\ntwo bodies that both stand still are no pair.\n\nParameters\n----------\n" +
           options_doc() +
           "\nReturns\n-------\nDistanceProfile\n    With `pairs`, `nearest` and `untested`; infinite if no two bodies "
           "are tested.\n\n" +
           invalid_input_docs;
}

std::string robot_profile_doc() {
    return "The distance of the nearest pair over a path, and which pair it is: of two links, or of a link and a body "
           "of "
           "the scene.\n\nParameters\n----------\nconfigurations : JointPath or array_like (n, variables)\n    With "
           "`times`, `velocities` and `accelerations` as for first_contact_on_path.\nscene : Scene, optional\n    The "
           "world; its margins have no effect.\nhandovers : sequence of tuples\n    As for first_contact_on_path.\n" +
           options_doc() +
           "\nReturns\n-------\nDistanceProfile\n    With `pairs`, `nearest` and `untested`; its `times` are stamps, "
           "or "
           "count segments: k + 0.5 is the middle of\n    segment k. Infinite if no two bodies are tested.\n\n" +
           invalid_input_docs;
}

} // namespace

void bind_profile(nb::class_<PythonScene>& scene) {
    static const std::string text = scene_profile_doc();
    scene.def("profile", profile_of_scene, nb::kw_only(), "tolerance"_a = 1e-2, "absolute_tolerance"_a = 0.0,
              "margins"_a = nb::make_tuple(), "time_tolerance"_a = 1e-6,
              nb::sig("def profile(self, *, tolerance: float = 0.01, absolute_tolerance: float = 0.0, margins: "
                      "numpy.typing.ArrayLike = (), time_tolerance: float = 1e-06) -> DistanceProfile"),
              text.c_str());
}

void bind_profile(nb::class_<PythonRobot>& robot) {
    static const std::string text = robot_profile_doc();
    robot.def(
        "profile",
        [](const PythonRobot& r, nb::handle configurations, nb::handle times, nb::handle velocities,
           nb::handle accelerations, nb::handle scene, double tolerance, double absolute_tolerance, nb::handle margins,
           double time_tolerance, nb::handle handovers) {
            const Asking question = r.asking();
            const nb::str find("first");
            return profile_of_robot(checker_of(r, {scene, 0, std::nullopt, default_time_tolerance, find}),
                                    {configurations, times, velocities, accelerations, handovers}, tolerance,
                                    absolute_tolerance, margins, time_tolerance);
        },
        "configurations"_a.none(), "times"_a = nb::none(), "velocities"_a = nb::none(), "accelerations"_a = nb::none(),
        nb::kw_only(), "scene"_a = nb::none(), "tolerance"_a = 1e-2, "absolute_tolerance"_a = 0.0,
        "margins"_a = nb::make_tuple(), "time_tolerance"_a = 1e-6, "handovers"_a.none() = nb::make_tuple(),
        nb::sig("def profile(self, configurations: numpy.typing.ArrayLike | JointPath, "
                "times: numpy.typing.ArrayLike | None = None, velocities: numpy.typing.ArrayLike | None = None, "
                "accelerations: numpy.typing.ArrayLike | None = None, *, scene: Scene | None = None, "
                "tolerance: float = 0.01, absolute_tolerance: float = 0.0, margins: numpy.typing.ArrayLike = (), "
                "time_tolerance: float = 1e-06, " CHASLES_HANDOVERS ") -> DistanceProfile"),
        text.c_str());
}

void bind_profile(nb::module_& module) {
    nb::class_<PythonProfile>(module, "DistanceProfile", doc("DistanceProfile"))
        .def_prop_ro(
            "times", [](const PythonProfile& p) { return array_of(p.found.times, {p.found.times.size()}); },
            nb::sig("def times(self) -> " CHASLES_ARRAY),
            "Array (n,): ascending, from 0 to 1; along a path of a robot as the times of its answers, or from 0 to the "
            "number "
            "of segments.")
        .def_prop_ro(
            "lower", [](const PythonProfile& p) { return array_of(p.found.lower, {p.found.lower.size()}); },
            nb::sig("def lower(self) -> " CHASLES_ARRAY),
            "Array (n,): from times[i] to times[i + 1] the distance is never below lower[i], mesh unit.")
        .def_prop_ro(
            "upper", [](const PythonProfile& p) { return array_of(p.found.upper, {p.found.upper.size()}); },
            nb::sig("def upper(self) -> " CHASLES_ARRAY),
            "Array (n,): from times[i] to times[i + 1] the distance is never above upper[i], mesh unit.")
        .def_prop_ro(
            "certain", [](const PythonProfile& p) { return p.found.certain; }, doc("DistanceProfile.certain"))
        .def(
            "zones",
            [](const PythonProfile& p, double margin) {
                const Zones zones = p.found.zones(margin);
                return std::pair(intervals_of(zones.inside), intervals_of(zones.doubt));
            },
            "margin"_a,
            "When the bodies are within a distance of each other, which may be one of the `margins` of the question or "
            "any "
            "other one. Two lists of pairs of times: when they are, and when they may be. Raises InvalidInput for a "
            "margin that is not in [0, 1e30].")
        .def_prop_ro(
            "free", [](const PythonProfile& p) { return intervals_of(p.found.free()); }, doc("DistanceProfile.free"))
        .def_prop_ro(
            "pairs", [](const PythonProfile& p) { return p.pairs; },
            nb::sig("def pairs(self) -> list[tuple[str, str]]"),
            "The names of the pairs that are the nearest at some time, of a scene or a robot; empty for two bodies.")
        .def_prop_ro(
            "nearest", [](const PythonProfile& p) { return p.found.nearest; },
            nb::sig("def nearest(self) -> list[int]"),
            "n - 1 numbers: from times[i] to times[i + 1] pairs[nearest[i]] is the nearest, by its upper bound. Empty "
            "without pairs.")
        .def_prop_ro(
            "untested", [](const PythonProfile& p) { return p.untested; },
            nb::sig("def untested(self) -> UntestedPairs | None"),
            "What the answer about a scene or a robot does not look at; None for two bodies.")
        .def("__repr__", [](const PythonProfile& p) {
            const double least = *std::ranges::min_element(p.found.lower),
                         most = *std::ranges::max_element(p.found.upper);
            return fmt::format("<chasles.DistanceProfile: {} steps, from {:.9g} to {:.9g}{}>", p.found.times.size() - 1,
                               least, most, p.found.certain ? "" : ", not as narrow as asked");
        });
    static const std::string text = profile_doc();
    module.def(
        "profile", ask, "moving"_a.none(), "fixed"_a.none(), "start"_a = nb::none(), "goal"_a = nb::none(),
        nb::kw_only(), "motion"_a = nb::none(), "fixed_start"_a = nb::none(), "fixed_goal"_a = nb::none(),
        "tolerance"_a = 1e-2, "absolute_tolerance"_a = 0.0, "margins"_a = nb::make_tuple(), "time_tolerance"_a = 1e-6,
        "max_turn"_a = nb::none(),
        nb::sig("def profile(moving: Polyhedron, fixed: Polyhedron, "
                "start: numpy.typing.ArrayLike | None = None, goal: numpy.typing.ArrayLike | None = None, *, "
                "motion: ScrewMotion | SweepMotion | ConstantVelocity | ConstantTwist | TimedPoses | Trajectory | "
                "Motion | typing.Literal['screw', 'sweep', 'velocity', 'twist'] | None = None, "
                "fixed_start: numpy.typing.ArrayLike | None = None, "
                "fixed_goal: numpy.typing.ArrayLike | None = None, tolerance: float = 0.01, "
                "absolute_tolerance: float = 0.0, margins: numpy.typing.ArrayLike = (), "
                "time_tolerance: float = 1e-06, max_turn: float | None = None) -> DistanceProfile"),
        text.c_str());
}

} // namespace chasles::python
