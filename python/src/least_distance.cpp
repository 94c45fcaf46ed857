// chasles.LeastDistance, chasles.least_distance, and the compiled part of chasles.least_distance_batch.
#include "chasles/query/least_distance.h"

#include "chasles/base/number_text.h"
#include "python/src/answer_members.h"
#include "python/src/bind.h"
#include "python/src/names.h"
#include "python/src/query_options.h"
#include "python/src/rows.h"
#include "python/src/signals.h"

#include <fmt/format.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>

namespace chasles::python {
namespace {

using namespace nb::literals;

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
    const WithoutGil without_gil;
    const EndsBySignals ends_by_signals;
    answer.found = least_distance({moving_body, fixed_body, plain(answer.motion), options});
    return answer;
}

/// By the goal of the body that moved in the query.
DistanceGradient gradient_of(const LeastAnswer& answer) {
    const Polyhedron& moving = polyhedron_of(answer.is_swapped ? answer.fixed : answer.moving, "moving");
    const Polyhedron& fixed = polyhedron_of(answer.is_swapped ? answer.moving : answer.fixed, "fixed");
    const Motion motion = plain(answer.motion);
    return answer.gradient.get([&] { return least_distance_gradient({moving, fixed, motion}, answer.found); });
}

nb::object numbers_of(const std::optional<DistanceGradient::Vector>& gradient) {
    return gradient ? array_of(std::span(gradient->data(), 6), {6}) : nb::none();
}

void bind_gradient(nb::class_<LeastAnswer>& type) {
    type.def_prop_ro(
            "gradient", [](const LeastAnswer& a) { return numbers_of(gradient_of(a).by_goal); },
            nb::sig("def gradient(self) -> " CHASLES_ARRAY " | None"),
            "The derivatives of the least distance by the goal pose of the moving body, shape (6,): by v, then by w "
            "(mesh unit per\nradian), where the goal (R, p) in the world becomes (exp(w) R, p + v). So v translates "
            "the goal, and the rotation vector\nw turns it about the origin of the body. None where the bodies touch. "
            "It is that of this minimum only if `isolated`.\nComputed in double on the first use. A swapped answer has "
            "the gradient of the query.\n\nRaises\n------\nInvalidInput\n    If the motion has no goal pose.")
        .def_prop_ro(
            "isolated", [](const LeastAnswer& a) { return gradient_of(a).isolated; }, doc("DistanceGradient.isolated"));
}

/// "0.25 at time 0.5, vertex 0 on face 4"
std::string summary(const LeastDistance& found) {
    std::string text = found.distance.upper > 0 ? fmt::format("{:.9g}", found.distance.lower) : "0, touching";
    text += " at time " + time_text(found.time.lower);
    if (!found.certain)
        text += doubt_about(found.distance);
    if (found.overlap && found.overlap->certain)
        text += ", overlapping";
    if (found.inside)
        text += found.inside->moving_is_inside ? ", the moving body inside of the fixed one"
                                               : ", the fixed body inside of the moving one";
    if (!found.contacts.empty())
        text += fmt::format(", {}{}", text_of(found.contacts.front()), found.contacts.size() > 1 ? ", ..." : "");
    return text;
}

constexpr MemberDocs member_docs{
    .time =
        "Lower end of a bracket of time, in [0, 1]. In the bracket the surfaces come as near as `distance_upper`. If "
        "the bodies touch, it is the bracket of the first contact.",
    .certain = doc("LeastDistance.certain"),
    .contacts = "The nearest features in the world frame at `time`. Their gaps are the distance.",
    .contacts_cut = doc("LeastDistance.contacts_cut"),
    .overlap = doc("LeastDistance.overlap"),
    .pose = doc("LeastDistance.pose"),
    .motion = "The motion of the query. A swapped answer keeps it.",
};

void bind_answer(nb::module_& module) {
    nb::class_<LeastAnswer> type(module, "LeastDistance", doc("LeastDistance"), collected<LeastAnswer>());
    type.def_prop_ro(
            "distance", [](const LeastAnswer& a) { return a.found.distance.lower; },
            "Lower end of the bracket around the least distance. It is proven: the surfaces never come nearer. Mesh "
            "unit; "
            "0 if the bodies touch.")
        .def_prop_ro(
            "distance_upper", [](const LeastAnswer& a) { return a.found.distance.upper; },
            "Upper end of the bracket around the least distance; 0 if the bodies touch.");
    type.def_prop_ro(
        "pair", [](const LeastAnswer& a) { return a.pair; },
        "The names of two bodies of a scene, the moving one first; None for two polyhedra.");
    bind_members(type, member_docs);
    bind_gradient(type);
    type.def("__repr__", [](const LeastAnswer& a) {
        const std::string pair = a.pair ? ", " + a.pair->first + " to " + a.pair->second : "";
        return "<chasles.LeastDistance: " + summary(a.found) + pair + ">";
    });
}

std::string least_distance_doc() {
    return "How near do two polyhedra come during a motion, when, and where?\n\n" + motion_docs() +
           "tolerance : float\n" + indented(doc("LeastDistanceOptions.tolerance")) + "time_tolerance : float\n" +
           indented(doc("LeastDistanceOptions.time_tolerance")) + max_turn_docs +
           "find : Find or str\n"
           "    'first': one pair of nearest features; 'first_with_all_contacts': every pair.\n"
           "\nReturns\n-------\nLeastDistance\n    `distance` to `distance_upper` is a bracket of the least "
           "distance.\n\n" +
           invalid_input_docs;
}

void answer_batch(nb::handle moving, nb::handle fixed, const RowMotions& motions, nb::handle array,
                  const LeastDistanceOptions& options, const RowOptions& rows, nb::handle report) {
    const Polyhedron& moving_body = polyhedron_of(moving, "moving");
    const Polyhedron& fixed_body = polyhedron_of(fixed, "fixed");
    const auto ask_about = [&](const Polyhedron& a, const Polyhedron& b, const Motion& motion) {
        return least_distance({a, b, motion, options});
    };
    motion_rows<LeastRow>(
        {moving_body, fixed_body}, motions, array, rows, report,
        [&](const Polyhedron& triangle, const Motion& rest) { static_cast<void>(ask_about(triangle, triangle, rest)); },
        [&](const Motion& motion, LeastRow& row) {
            const LeastDistance found = ask_about(moving_body, fixed_body, motion);
            throw_if_cancelled(); // then the bracket may be wide
            write(found, row);
        });
}

} // namespace

const char* doubt_about(const Bracket& distance) {
    return distance.upper > 0 ? " (uncertain: the bracket is wider than the tolerance)"
                              : " (uncertain: a rounding error decides whether the features named here meet)";
}

void bind_least_distance(nb::module_& module) {
    static const std::string text = least_distance_doc();
    bind_answer(module);
    module.def(
        "least_distance", ask, "moving"_a.none(), "fixed"_a.none(), "start"_a = nb::none(), "goal"_a = nb::none(),
        nb::kw_only(), "motion"_a = nb::none(), "fixed_start"_a = nb::none(), "fixed_goal"_a = nb::none(),
        "tolerance"_a = default_tolerance, "time_tolerance"_a = default_time_tolerance, "max_turn"_a = nb::none(),
        "find"_a.none() = "first",
        nb::sig(
            "def least_distance(moving: Polyhedron, fixed: Polyhedron, "
            "start: numpy.typing.ArrayLike | None = None, goal: numpy.typing.ArrayLike | None = None, *, "
            "motion: ScrewMotion | SweepMotion | ConstantVelocity | ConstantTwist | TimedPoses | Trajectory | Motion | "
            "typing.Literal['screw', 'sweep', 'velocity', 'twist'] | None = None, "
            "fixed_start: numpy.typing.ArrayLike | None = None, "
            "fixed_goal: numpy.typing.ArrayLike | None = None, tolerance: float = 1e-06, "
            "time_tolerance: float = 1e-12, max_turn: float | None = None, " CHASLES_FIND_TYPE ") -> LeastDistance"),
        text.c_str());
    module.def(
        "_least_distance_batch",
        [](nb::handle moving, nb::handle fixed, nb::handle starts, nb::handle goals, nb::handle motions,
           nb::handle table, double tolerance, double time_tolerance, nb::handle motion, std::optional<double> max_turn,
           unsigned threads, bool marks_errors, nb::handle report) {
            answer_batch(moving, fixed, {starts, goals, motions}, table,
                         {.tolerance = tolerance, .time_tolerance = time_tolerance},
                         {kind_from(motion), max_turn, threads, marks_errors}, report);
        },
        "moving"_a.none(), "fixed"_a.none(), "starts"_a.none(), "goals"_a.none(), "motions"_a.none(), "table"_a,
        nb::kw_only(), "tolerance"_a, "time_tolerance"_a, "motion"_a.none(), "max_turn"_a.none(), "threads"_a,
        "marks_errors"_a, "report"_a.none());
}

} // namespace chasles::python
