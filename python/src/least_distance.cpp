// chasles.LeastDistance, chasles.least_distance, and the compiled part of chasles.least_distance_batch.
#include "chasles/query/least_distance.h"

#include "python/src/answer.h"
#include "python/src/bind.h"
#include "python/src/docstrings.h"
#include "python/src/names.h"
#include "python/src/query_options.h"
#include "python/src/rows.h"

#include <fmt/format.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/variant.h>

namespace chasles::python {
namespace {

using namespace nb::literals;

constexpr double default_tolerance = LeastDistanceOptions().tolerance;

/// The answer with the bodies and the motion of its query.
struct LeastAnswer {
    LeastDistance found;
    nb::object moving; ///< the bodies of the query, kept alive by the answer
    nb::object fixed;
    TypedMotion motion;
    bool is_swapped = false; ///< the bodies have swapped their roles since the query; the motion has not changed
};

LeastAnswer ask(nb::handle moving, nb::handle fixed, nb::handle start, nb::handle goal, nb::handle motion,
                nb::handle fixed_start, nb::handle fixed_goal, double tolerance, double time_tolerance,
                std::optional<double> max_turn, nb::handle find) {
    const Polyhedron& moving_body = polyhedron_of(moving, "moving");
    const Polyhedron& fixed_body = polyhedron_of(fixed, "fixed");
    LeastAnswer answer{{},
                       nb::borrow(moving),
                       nb::borrow(fixed),
                       motion_from({start, goal, motion, fixed_start, fixed_goal, max_turn})};
    const LeastDistanceOptions options{tolerance, time_tolerance, find_from(find)};
    const nb::gil_scoped_release release;
    answer.found = least_distance({moving_body, fixed_body, plain(answer.motion), options});
    return answer;
}

LeastAnswer swapped(const LeastAnswer& answer) {
    LeastAnswer other = answer;
    other.found = answer.found.swapped();
    std::swap(other.moving, other.fixed);
    other.is_swapped = !answer.is_swapped;
    return other;
}

std::string summary(const LeastDistance& found) {
    std::string text =
        found.distance.upper <= 0 ? std::string("0, touching") : fmt::format("{:.9g}", found.distance.lower);
    text += fmt::format(" at time {:.12g}", found.time.lower);
    if (!found.certain)
        text += " (uncertain)";
    if (!found.contacts.empty())
        text += ", " + text_of(found.contacts.front());
    return text;
}

void bind_answer(nb::module_& module) {
    nb::class_<LeastAnswer>(module, "LeastDistance", doc("LeastDistance"))
        .def_prop_ro(
            "distance", [](const LeastAnswer& a) { return a.found.distance.lower; },
            "Proven: the surfaces are never nearer. Mesh unit; 0 if the bodies touch.")
        .def_prop_ro(
            "distance_upper", [](const LeastAnswer& a) { return a.found.distance.upper; },
            "Upper end of the bracket of the least distance; 0 if the bodies touch.")
        .def_prop_ro(
            "time", [](const LeastAnswer& a) { return a.found.time.lower; },
            "Lower end of a bracket of time within which the surfaces come as near as `distance_upper`, in [0, 1]; of "
            "the first contact if they touch.")
        .def_prop_ro(
            "time_upper", [](const LeastAnswer& a) { return a.found.time.upper; },
            "Upper end of the bracket of the time.")
        .def_prop_ro(
            "tau", [](const LeastAnswer& a) { return a.found.tau.lower; },
            "Lower end of the same bracket in the paper's parameter.")
        .def_prop_ro(
            "tau_upper", [](const LeastAnswer& a) { return a.found.tau.upper; }, "Upper end of the bracket of tau.")
        .def_prop_ro(
            "certain", [](const LeastAnswer& a) { return a.found.certain; }, doc("LeastDistance.certain"))
        .def_prop_ro(
            "contacts", [](const LeastAnswer& a) { return tuple_of(a.found.contacts); },
            nb::sig("def contacts(self) -> tuple[Contact, ...]"), doc("LeastDistance.contacts"))
        .def_prop_ro(
            "contacts_cut", [](const LeastAnswer& a) { return a.found.contacts_cut; },
            doc("LeastDistance.contacts_cut"))
        .def_prop_ro(
            "overlap", [](const LeastAnswer& a) { return a.found.overlap; }, doc("LeastDistance.overlap"))
        .def_prop_ro(
            "pose", [](const LeastAnswer& a) { return matrix_of(a.found.pose); },
            nb::sig("def pose(self) -> " CHASLES_ARRAY), doc("LeastDistance.pose"))
        .def_prop_ro(
            "fixed_pose", [](const LeastAnswer& a) { return matrix_of(a.found.fixed_pose); },
            nb::sig("def fixed_pose(self) -> " CHASLES_ARRAY),
            "The pose of the fixed body in the world at the same time.")
        .def_prop_ro(
            "work", [](const LeastAnswer& a) { return a.found.work; }, doc("Work"))
        .def_prop_ro(
            "moving", [](const LeastAnswer& a) { return a.moving; }, nb::sig("def moving(self) -> Polyhedron"),
            "The moving body of the query.")
        .def_prop_ro(
            "fixed", [](const LeastAnswer& a) { return a.fixed; }, nb::sig("def fixed(self) -> Polyhedron"),
            "The fixed body of the query.")
        .def_prop_ro(
            "motion", [](const LeastAnswer& a) { return a.motion; },
            nb::sig("def motion(self) -> ScrewMotion | SweepMotion"),
            "The motion of the query. A swapped answer keeps it.")
        .def_ro("is_swapped", &LeastAnswer::is_swapped, "Whether the bodies have swapped their roles since the query.")
        .def("swapped", swapped, doc("LeastDistance.swapped"))
        .def("__repr__", [](const LeastAnswer& a) { return "<chasles.LeastDistance: " + summary(a.found) + ">"; });
}

std::string least_distance_doc() {
    return "How near do two polyhedra come during a motion, when, and where?\n\n"
           "Parameters\n----------\nmoving, fixed : Polyhedron\n"
           "start, goal, motion, fixed_start, fixed_goal, time_tolerance, max_turn\n"
           "    As for `first_contact`.\n"
           "tolerance : float\n" +
           indented(doc("LeastDistanceOptions.tolerance")) +
           "find : Find or str\n"
           "    'first': one pair of nearest features; 'first_with_all_contacts': all of them.\n"
           "\nReturns\n-------\nLeastDistance\n    From `distance` to `distance_upper` is a proven bracket.\n\n"
           "Raises\n------\nInvalidInput\n    A ValueError. Its message names the input, the place and the reason.";
}

void answer_batch(nb::handle moving, nb::handle fixed, nb::handle starts, nb::handle goals, nb::handle array,
                  const LeastDistanceOptions& options, double max_turn, unsigned threads, bool marks_errors,
                  nb::handle report) {
    const Polyhedron& moving_body = polyhedron_of(moving, "moving");
    const Polyhedron& fixed_body = polyhedron_of(fixed, "fixed");
    const auto ask_about = [&](const Polyhedron& a, const Polyhedron& b, const Motion& motion) {
        return least_distance({a, b, motion, options});
    };
    motion_rows<LeastRow>(
        starts, goals, array, {max_turn, threads, marks_errors}, report,
        [&](const Polyhedron& triangle, const Motion& rest) { static_cast<void>(ask_about(triangle, triangle, rest)); },
        [&](const Motion& motion, LeastRow& row) { write(ask_about(moving_body, fixed_body, motion), row); });
}

} // namespace

void bind_least_distance(nb::module_& module) {
    static const std::string text = least_distance_doc();
    bind_answer(module);
    module.def("least_distance", ask, "moving"_a.none(), "fixed"_a.none(), "start"_a = nb::none(),
               "goal"_a = nb::none(), nb::kw_only(), "motion"_a = nb::none(), "fixed_start"_a = nb::none(),
               "fixed_goal"_a = nb::none(), "tolerance"_a = default_tolerance,
               "time_tolerance"_a = default_time_tolerance, "max_turn"_a = nb::none(), "find"_a.none() = "first",
               nb::sig("def least_distance(moving: Polyhedron, fixed: Polyhedron, "
                       "start: numpy.typing.ArrayLike | None = None, goal: numpy.typing.ArrayLike | None = None, *, "
                       "motion: ScrewMotion | SweepMotion | None = None, "
                       "fixed_start: numpy.typing.ArrayLike | None = None, "
                       "fixed_goal: numpy.typing.ArrayLike | None = None, tolerance: float = 1e-06, "
                       "time_tolerance: float = 1e-12, max_turn: float | None = None, " CHASLES_FIND_TYPE
                       ") -> LeastDistance"),
               text.c_str());
    module.def(
        "_least_distance_batch",
        [](nb::handle moving, nb::handle fixed, nb::handle starts, nb::handle goals, nb::handle table, double tolerance,
           double time_tolerance, double max_turn, unsigned threads, bool marks_errors, nb::handle report) {
            answer_batch(moving, fixed, starts, goals, table,
                         {.tolerance = tolerance, .time_tolerance = time_tolerance}, max_turn, threads, marks_errors,
                         report);
        },
        "moving"_a.none(), "fixed"_a.none(), "starts"_a, "goals"_a, "table"_a, nb::kw_only(), "tolerance"_a,
        "time_tolerance"_a, "max_turn"_a, "threads"_a, "marks_errors"_a, "report"_a.none());
}

} // namespace chasles::python
