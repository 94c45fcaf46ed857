// chasles.RobotContact, chasles.RobotChecker, and questions about robots.
#include "python/src/robot.h"

#include "chasles/base/invalid_input.h"
#include "python/src/answer.h"
#include "python/src/answer_members.h"
#include "python/src/certificate.h"
#include "python/src/docstrings.h"
#include "python/src/names.h"
#include "python/src/query_options.h"
#include "python/src/scene.h"
#include "view/names.h"
#include "view/stamped_speeds.h"
#include "view/why_uncertain.h"

#include <array>
#include <fmt/format.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/string_view.h>
#include <nanobind/stl/vector.h>

namespace chasles::python {

using namespace nb::literals;

RobotChecker checker_of(const Robot& robot, const RobotArguments& arguments) {
    const Scene* scene = nullptr;
    std::optional<Asking> about_scene; // its bodies are read here; the checker keeps what it needs
    if (!arguments.scene.is_none()) {
        const PythonScene* given = nullptr;
        if (!nb::try_cast(arguments.scene, given) || !given)
            throw nb::type_error("scene: must be a chasles.Scene");
        scene = &given->scene;
        about_scene.emplace(given->use, "scene");
    }
    return RobotChecker(robot, scene,
                        {{arguments.margin, arguments.hold, arguments.time_tolerance, find_from(arguments.find)}});
}

Configuration configuration_from(nb::handle argument, const std::string& name) {
    if (nb::isinstance<JointPath>(argument))
        throw InvalidInput(name +
                           ": is a JointPath, not a configuration: first_contact_on_path, least_distance_on_path "
                           "and profile take paths");
    const DoubleArray array(argument, name);
    if (array.shape().size() != 1)
        throw InvalidInput(name + ": must have the shape (variables,), and has " + array.shape_text());
    return Eigen::Map<const Configuration>(array.numbers().data(), Eigen::Index(array.numbers().size()));
}

std::pair<Configuration, Configuration> edge_from(nb::handle start, nb::handle goal) {
    Configuration from = configuration_from(start, "start");
    if (goal.is_none())
        throw nb::type_error("goal: is missing; an edge goes from a start to a goal");
    return {std::move(from), configuration_from(goal, "goal")};
}

Eigen::MatrixXd configurations_from(nb::handle argument, const std::string& name) {
    using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    const DoubleArray array(argument, name);
    if (array.shape().size() != 2)
        throw InvalidInput(name + ": must have the shape (n, variables), and has " + array.shape_text());
    return Eigen::Map<const Rows>(array.numbers().data(), array.shape()[0], array.shape()[1]);
}

nb::object array_of(const Configuration& configuration) {
    return array_of(std::span(configuration.data(), std::size_t(configuration.size())),
                    {std::size_t(configuration.size())});
}

std::vector<std::string> names_of(const Robot& robot) {
    std::vector<std::string> names;
    for (const RobotVariable& variable : robot.variables())
        names.push_back(variable.name);
    return names;
}

std::vector<Configuration> rows_of(nb::handle argument, const std::string& name) {
    const Eigen::MatrixXd matrix = configurations_from(argument, name);
    std::vector<Configuration> rows;
    for (Eigen::Index i = 0; i < matrix.rows(); ++i)
        rows.emplace_back(matrix.row(i));
    return rows;
}

JointPath path_from(const Robot& robot, const PathArguments& arguments) {
    const auto& [configurations, times, velocities, accelerations, handovers] = arguments;
    if (const JointPath* path = nullptr; nb::try_cast(configurations, path) && path) {
        if (!times.is_none() || !velocities.is_none() || !accelerations.is_none())
            throw InvalidInput("times: a JointPath has its own");
        return *path;
    }
    const std::vector<Configuration> rows = rows_of(configurations, "configurations");
    if (times.is_none()) {
        if (!velocities.is_none() || !accelerations.is_none())
            throw InvalidInput("times: are needed with velocities");
        return JointPath::straight(robot, rows);
    }
    const Configuration stamps = configuration_from(times, "times");
    const std::span<const double> of_rows(stamps.data(), std::size_t(stamps.size()));
    if (velocities.is_none()) {
        if (!accelerations.is_none())
            throw InvalidInput("velocities: are needed with accelerations");
        return JointPath::straight(robot, rows, of_rows);
    }
    const std::vector<Configuration> rates = rows_of(velocities, "velocities");
    if (accelerations.is_none())
        return JointPath::cubic(robot, of_rows, rows, rates);
    return JointPath::quintic(robot, of_rows, rows, rates, rows_of(accelerations, "accelerations"));
}

namespace {

std::string text_of(const PythonRobotAnswer& answer) {
    if (answer.found.verdict == Verdict::unknown)
        return fmt::format("<chasles.RobotContact: segment {}, unknown: the limit was reached; proven clear until {}>",
                           answer.found.segment, answer.clear_until());
    if (!answer.found.pair)
        return fmt::format("<chasles.RobotContact: clear; {} pairs are tested, and {} are not>",
                           answer.found.untested->tested, answer.found.untested->total());
    FirstContact found = answer.found.contact;
    found.verdict = answer.found.verdict;
    found.certain = answer.found.certain;
    const std::string why = view::why_uncertain(found, answer.is_in_last_segment);
    found.time = answer.time();
    return fmt::format("<chasles.RobotContact: segment {}, {}>", answer.found.segment,
                       summary(found, answer.found.pair->first + " on " + answer.found.pair->second, why));
}

void bind_contact(nb::module_& module) {
    using Answer = PythonRobotAnswer;
    nb::class_<Answer> type(module, "RobotContact", "The first contact of a robot along a path.");
    bind_inside(type, [](const Answer& a) -> const std::optional<Inside>& { return a.found.contact.inside; });
    type.def_prop_ro(
            "verdict", [](const Answer& a) { return member_of(a.found.verdict); },
            nb::sig("def verdict(self) -> chasles.enums.Verdict"), "'clear', 'contact' or 'contact_at_start'.")
        .def_prop_ro(
            "segment", [](const Answer& a) { return a.found.segment; },
            "Of the contact; the last one if the path is clear.")
        .def_prop_ro(
            "time", [](const Answer& a) { return a.time().lower; },
            "Lower end of the bracket of the contact: within the segment, in [0, 1], or in stamps.")
        .def_prop_ro(
            "time_upper", [](const Answer& a) { return a.time().upper; }, "Upper end of the bracket.")
        .def_prop_ro(
            "certain", [](const Answer& a) { return a.found.certain; },
            "False where contact could not be told from a miss.")
        .def_prop_ro(
            "pair", [](const Answer& a) { return pair_of(a.found.pair); },
            nb::sig("def pair(self) -> tuple[str, str] | None"),
            "Two links or parts, or one and a body of the scene; None if the path is clear.")
        .def_prop_ro(
            "contacts", [](const Answer& a) { return tuple_of(a.found.contact.contacts); },
            nb::sig("def contacts(self) -> tuple[Contact, ...]"),
            "Where the pair touches, in the world; the first one of the pair moves. Speeds are per unit of `time`.")
        .def_prop_ro(
            "contacts_cut", [](const Answer& a) { return a.found.contact.contacts_cut; },
            doc("FirstContact.contacts_cut"))
        .def_prop_ro(
            "overlap", [](const Answer& a) { return a.found.contact.overlap; }, doc("FirstContact.overlap"))
        .def_prop_ro(
            "configuration", [](const Answer& a) { return array_of(a.found.configuration); },
            nb::sig("def configuration(self) -> " CHASLES_ARRAY), "At `time`; at the end of the path if it is clear.")
        .def_prop_ro("clear_until", &Answer::clear_until,
                     "Before this time of the segment nothing comes within the margin.")
        .def_prop_ro(
            "clear_configuration", [](const Answer& a) { return array_of(a.found.clear_configuration); },
            nb::sig("def clear_configuration(self) -> " CHASLES_ARRAY), "At `clear_until`.")
        .def_prop_ro(
            "held", [](const Answer& a) { return tuple_of(a.found.contact.held); },
            nb::sig("def held(self) -> tuple[Contact, ...]"),
            "With hold: what of the pair is within the margin where the segment begins, in the world. Empty if the "
            "path is clear, "
            "which\nnames no pair.")
        .def_prop_ro(
            "untested", [](const Answer& a) { return *a.found.untested; }, "What the answer does not look at.")
        .def_prop_ro(
            "pairs", [](const Answer& a) { return a.found.pairs; }, doc("RobotAnswer.pairs"))
        .def_prop_ro(
            "work", [](const Answer& a) { return a.found.work; }, doc("Work"))
        .def("__repr__", text_of);
}

} // namespace

PythonRobotAnswer answer_on_edge(const RobotChecker& checker, nb::handle start, nb::handle goal) {
    const auto [from, to] = edge_from(start, goal);
    return {asked_here([&] { return checker.first_contact(from, to); })};
}

PythonRobotAnswer answer_on_path(const RobotChecker& checker, const PathArguments& arguments) {
    const JointPath path = path_from(checker.robot(), arguments);
    const std::vector<Handover> handovers = handovers_from(arguments);
    RobotAnswer found = asked([&] { return checker.first_contact(path, handovers); });
    const bool is_last = found.segment + 1 == path.segments().size(), in_stamps = has_stamps(arguments);
    if (in_stamps)
        view::count_in_stamps(found.contact, view::duration_of(path, found.segment));
    return {std::move(found), in_stamps, is_last};
}

nb::tuple answers_on_edges(const RobotChecker& checker, nb::handle starts, nb::handle goals, unsigned threads) {
    const Eigen::MatrixXd from = configurations_from(starts, "starts"), to = configurations_from(goals, "goals");
    const std::vector<RobotAnswer> answers = asked([&] { return checker.first_contacts(from, to, threads); });
    std::array<std::vector<double>, 4> numbers;
    nb::list verdicts, first, second;
    for (const RobotAnswer& answer : answers) {
        const PythonRobotAnswer shown{answer};
        const std::array values{shown.time().lower, shown.time().upper, shown.clear_until(), double(answer.certain)};
        verdicts.append(view::name_of(answer.verdict));
        for (std::size_t i = 0; i < values.size(); ++i)
            numbers[i].push_back(values[i]);
        first.append(answer.pair ? answer.pair->first : "");
        second.append(answer.pair ? answer.pair->second : "");
    }
    nb::list fields;
    fields.append(verdicts);
    for (const std::vector<double>& field : numbers)
        fields.append(array_of(std::span(field), {field.size()}));
    fields.append(first);
    fields.append(second);
    return nb::tuple(fields);
}

#define CHASLES_ROBOT_OPTIONS                                                                                          \
    "*, margin: float = 0.0, hold: float | None = None, time_tolerance: float = 1e-12, " CHASLES_FIND_TYPE

void bind_robot_answers(nb::module_& module) {
    static const std::string on_path_doc =
        std::string("Along a path: a JointPath; or configurations: straight, or cubic with velocities, or quintic with "
                    "accelerations, too.") +
        handovers_doc;
    bind_contact(module);
    nb::class_<RobotChecker> type(module, "RobotChecker", doc("RobotChecker"), nb::dynamic_attr());
    bind_certificates(type);
    type.def(
            "__init__",
            [](nb::pointer_and_handle<RobotChecker> checker, const PythonRobot& robot, nb::handle scene, double margin,
               std::optional<double> hold, double time_tolerance, nb::handle find) {
                new (checker.p) RobotChecker(checker_of(robot, {scene, margin, hold, time_tolerance, find}));
                checker.h.attr("_scene") = scene; // bodies may follow functions of Python, which the scene owns
            },
            "robot"_a, "scene"_a = nb::none(), nb::kw_only(), "margin"_a = 0.0, "hold"_a = nb::none(),
            "time_tolerance"_a = default_time_tolerance, "find"_a.none() = "first",
            nb::sig("def __init__(self, robot: Robot, scene: Scene | None = None, " CHASLES_ROBOT_OPTIONS ") -> None"),
            "Keeps the state of the robot and of the scene.")
        .def_prop_ro(
            "untested", [](const RobotChecker& checker) { return checker.untested(); },
            "What no answer of the checker looks at.")
        .def_prop_ro(
            "robot", [](const RobotChecker& checker) { return PythonRobot(checker.robot()); },
            "A copy of the robot, as it was when the checker was made.")
        .def("first_contact", answer_on_edge, "start"_a.none(), "goal"_a = nb::none(),
             nb::sig("def first_contact(self, start: numpy.typing.ArrayLike, goal: numpy.typing.ArrayLike) -> "
                     "RobotContact"),
             "Along the straight edge between two configurations.")
        .def(
            "is_clear",
            [](const RobotChecker& checker, nb::handle start, nb::handle goal) {
                const Configuration from = configuration_from(start, "start");
                const Configuration to = goal.is_none() ? from : configuration_from(goal, "goal");
                return asked_here([&] { return checker.is_clear(from, to); });
            },
            "start"_a.none(), "goal"_a = nb::none(),
            nb::sig("def is_clear(self, start: numpy.typing.ArrayLike, goal: numpy.typing.ArrayLike | None = None) -> "
                    "bool"),
            "Whether the straight edge, or the one configuration, is proven clear.")
        .def(
            "pairs_in_contact",
            [](const RobotChecker& checker, nb::handle configuration) {
                const Configuration at = configuration_from(configuration, "configuration");
                std::vector<std::pair<std::string, std::string>> names;
                for (const RobotPair& pair : asked_here([&] { return checker.pairs_in_contact(at); }))
                    names.emplace_back(pair.first, pair.second);
                return names;
            },
            "configuration"_a.none(),
            nb::sig("def pairs_in_contact(self, configuration: numpy.typing.ArrayLike) -> list[tuple[str, str]]"),
            "The names of all pairs that touch, or are within the margin, at a configuration where the motions of the\n"
            "scene begin; those of which that cannot be told, too.")
        .def(
            "first_contact_on_path",
            [](const RobotChecker& checker, nb::handle configurations, nb::handle times, nb::handle velocities,
               nb::handle accelerations, nb::handle handovers) {
                return answer_on_path(checker, {configurations, times, velocities, accelerations, handovers});
            },
            "configurations"_a.none(), "times"_a = nb::none(), "velocities"_a = nb::none(),
            "accelerations"_a = nb::none(), nb::kw_only(), "handovers"_a.none() = nb::make_tuple(),
            nb::sig("def first_contact_on_path(self, configurations: numpy.typing.ArrayLike | JointPath, "
                    "times: numpy.typing.ArrayLike | None = None, velocities: numpy.typing.ArrayLike | None = None, "
                    "accelerations: numpy.typing.ArrayLike | None = None, *, " CHASLES_HANDOVERS ") -> RobotContact"),
            on_path_doc.c_str())
        .def("least_distance", clearance_on_edge, "start"_a.none(), "goal"_a = nb::none(),
             "tolerance"_a = default_tolerance,
             nb::sig("def least_distance(self, start: numpy.typing.ArrayLike, goal: numpy.typing.ArrayLike, "
                     "tolerance: float = 1e-6) -> RobotClearance"),
             "How near the robot comes to its world and to itself along the straight edge.")
        .def(
            "least_distance_on_path",
            [](const RobotChecker& checker, nb::handle configurations, nb::handle times, nb::handle velocities,
               nb::handle accelerations, double tolerance, nb::handle handovers) {
                return clearance_on_path(checker, {configurations, times, velocities, accelerations, handovers},
                                         tolerance);
            },
            "configurations"_a.none(), "times"_a = nb::none(), "velocities"_a = nb::none(),
            "accelerations"_a = nb::none(), "tolerance"_a = default_tolerance, nb::kw_only(),
            "handovers"_a.none() = nb::make_tuple(),
            nb::sig("def least_distance_on_path(self, configurations: numpy.typing.ArrayLike | JointPath, "
                    "times: numpy.typing.ArrayLike | None = None, velocities: numpy.typing.ArrayLike | None = None, "
                    "accelerations: numpy.typing.ArrayLike | None = None, tolerance: float = 1e-6, "
                    "*, " CHASLES_HANDOVERS ") -> RobotClearance"),
            "Likewise along a path, as in first_contact_on_path.")
        .def("first_contacts", answers_on_edges, "starts"_a.none(), "goals"_a.none(), "threads"_a = 0,
             nb::sig("def first_contacts(self, starts: numpy.typing.ArrayLike, goals: numpy.typing.ArrayLike, "
                     "threads: int = 0) -> tuple"),
             "The fields of chasles.first_contacts_on_edges, one after another.");
}

} // namespace chasles::python
