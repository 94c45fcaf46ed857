// chasles.DistanceProfile and chasles.profile.
#include "chasles/query/profile.h"

#include "python/src/arrays.h"
#include "python/src/bind.h"
#include "python/src/body.h"
#include "python/src/docstrings.h"
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
using Intervals = std::vector<std::pair<double, double>>;

Intervals intervals_of(const std::vector<Bracket>& parts) {
    Intervals intervals;
    for (const Bracket& part : parts)
        intervals.emplace_back(part.lower, part.upper);
    return intervals;
}

DistanceProfile ask(nb::handle moving, nb::handle fixed, nb::handle start, nb::handle goal, nb::handle motion,
                    nb::handle fixed_start, nb::handle fixed_goal, double tolerance, double absolute_tolerance,
                    nb::handle margins, double time_tolerance, std::optional<double> max_turn) {
    const Polyhedron& moving_body = polyhedron_of(moving, "moving");
    const Polyhedron& fixed_body = polyhedron_of(fixed, "fixed");
    const TypedMotion typed = motion_from({start, goal, motion, fixed_start, fixed_goal, max_turn});
    ProfileOptions options{.tolerance = tolerance,
                           .absolute_tolerance = absolute_tolerance,
                           .margins = {},
                           .time_tolerance = time_tolerance};
    const DoubleArray numbers(margins, "margins");
    options.margins.assign(numbers.numbers().begin(), numbers.numbers().end());
    const WithoutGil without_gil;
    const EndsBySignals ends_by_signals;
    return profile({moving_body, fixed_body, plain(typed), options});
}

std::string profile_doc() {
    return "How far apart are two polyhedra over a motion? Bounds of their distance, proven for every time.\n\n" +
           motion_docs() + "tolerance : float\n" + indented(doc("ProfileOptions.tolerance")) +
           "absolute_tolerance : float\n" + indented(doc("ProfileOptions.absolute_tolerance")) +
           "margins : array_like of floats\n" + indented(doc("ProfileOptions.margins")) + "time_tolerance : float\n" +
           indented(doc("ProfileOptions.time_tolerance")) + max_turn_docs +
           "\nReturns\n-------\nDistanceProfile\n    `times`, `lower` and `upper`; `zones` and `free`.\n\n" +
           invalid_input_docs;
}

} // namespace

void bind_profile(nb::module_& module) {
    nb::class_<DistanceProfile>(module, "DistanceProfile", doc("DistanceProfile"))
        .def_prop_ro(
            "times", [](const DistanceProfile& p) { return array_of(p.times, {p.times.size()}); },
            nb::sig("def times(self) -> " CHASLES_ARRAY), "Array (n,): ascending, from 0 to 1.")
        .def_prop_ro(
            "lower", [](const DistanceProfile& p) { return array_of(p.lower, {p.lower.size()}); },
            nb::sig("def lower(self) -> " CHASLES_ARRAY),
            "Array (n,): from times[i] to times[i + 1] the distance is never below lower[i], mesh unit.")
        .def_prop_ro(
            "upper", [](const DistanceProfile& p) { return array_of(p.upper, {p.upper.size()}); },
            nb::sig("def upper(self) -> " CHASLES_ARRAY),
            "Array (n,): from times[i] to times[i + 1] the distance is never above upper[i], mesh unit.")
        .def_prop_ro(
            "certain", [](const DistanceProfile& p) { return p.certain; }, doc("DistanceProfile.certain"))
        .def(
            "zones",
            [](const DistanceProfile& p, double margin) {
                const Zones zones = p.zones(margin);
                return std::pair(intervals_of(zones.inside), intervals_of(zones.doubt));
            },
            "margin"_a,
            "When the bodies are within a distance of each other, which may be one of the `margins` of the question or "
            "any "
            "other one. Two lists of pairs of times: when they are, and when they may be. Raises InvalidInput for a "
            "margin that is not in [0, 1e30].")
        .def_prop_ro(
            "free", [](const DistanceProfile& p) { return intervals_of(p.free()); }, doc("DistanceProfile.free"))
        .def("__repr__", [](const DistanceProfile& p) {
            const double least = *std::ranges::min_element(p.lower), most = *std::ranges::max_element(p.upper);
            return fmt::format("<chasles.DistanceProfile: {} steps, from {:.9g} to {:.9g}{}>", p.times.size() - 1,
                               least, most, p.certain ? "" : ", not as narrow as asked");
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
