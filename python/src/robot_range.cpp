// chasles.RobotRange, chasles.ClearBox, and questions about boxes of configurations.
#include "chasles/robot/range.h"

#include "python/src/docstrings.h"
#include "python/src/query_options.h"
#include "python/src/robot.h"
#include "python/src/scene.h"
#include "view/names.h"

#include <fmt/format.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/string_view.h>
#include <nanobind/stl/vector.h>

namespace chasles::python {
namespace {

using namespace nb::literals;

struct PythonRange {
    RobotRange found;
    ConfigurationBox box;
    std::vector<std::string> joints;
};

struct PythonClearBox {
    ClearBox found;
};

/// Both ends of each box, of the joints that move: (n, 2, joints).
nb::object array_of_boxes(const std::vector<ConfigurationBox>& boxes, const std::vector<std::size_t>& joints) {
    std::vector<double> numbers;
    for (const ConfigurationBox& box : boxes)
        for (const Configuration* const end : {&box.lower, &box.upper})
            for (const std::size_t joint : joints)
                numbers.push_back((*end)[Eigen::Index(joint)]);
    return array_of(std::span(numbers), {boxes.size(), 2, joints.size()});
}

ConfigurationBox box_from(nb::handle lower, nb::handle upper) {
    return {configuration_from(lower, "lower"), configuration_from(upper, "upper")};
}

struct RangeArguments {
    double tolerance;
    double seconds;
    unsigned threads;
    std::size_t most_cells;

    [[nodiscard]] RangeOptions options() const { return {tolerance, seconds, threads, most_cells}; }
};

PythonRange range_of(const RobotChecker& checker, const ConfigurationBox& box, const RangeArguments& arguments) {
    PythonRange range{asked([&] { return checker.range(box, arguments.options()); }), box, {}};
    for (const std::size_t joint : range.found.joints)
        range.joints.push_back(checker.robot().variables()[joint].name);
    return range;
}

/// Around the middle of the box, unless a configuration is given.
PythonClearBox clear_box_of(const RobotChecker& checker, const ConfigurationBox& box, nb::handle around,
                            const RangeArguments& arguments) {
    Configuration middle = box.lower;
    if (!around.is_none())
        middle = configuration_from(around, "around");
    else if (box.upper.size() == box.lower.size())
        middle += 0.5 * (box.upper - box.lower);
    return {asked([&] { return checker.clear_box(box, middle, arguments.options()); })};
}

RobotChecker checker_with(const PythonRobot& robot, nb::handle scene, double margin) {
    const nb::str find("first");
    return checker_of(robot, {scene, margin, std::nullopt, default_time_tolerance, find});
}

void bind_range(nb::module_& module) {
    using Range = PythonRange;
    nb::class_<Range>(module, "RobotRange", doc("RobotRange"))
        .def_prop_ro(
            "verdict", [](const Range& r) { return std::string(view::name_of(r.found.verdict)); },
            "'clear': the robot touches nothing in any configuration of the box. 'contact': it touches at the witness. "
            "'open': neither is proven.")
        .def_prop_ro(
            "joints", [](const Range& r) { return r.joints; }, "The names of the variables that move in the box.")
        .def_prop_ro(
            "lower", [](const Range& r) { return array_of(r.box.lower); }, nb::sig("def lower(self) -> " CHASLES_ARRAY),
            "The lower ends of the box, array (variables,).")
        .def_prop_ro(
            "upper", [](const Range& r) { return array_of(r.box.upper); }, nb::sig("def upper(self) -> " CHASLES_ARRAY),
            "The upper ends of the box, array (variables,).")
        .def_prop_ro(
            "boxes", [](const Range& r) { return array_of_boxes(r.found.clear, r.found.joints); },
            nb::sig("def boxes(self) -> " CHASLES_ARRAY),
            "Boxes that are proven clear, the largest ones first: lower and upper ends of `joints`, array (n, 2, "
            "joints).")
        .def_prop_ro(
            "contact_boxes", [](const Range& r) { return array_of_boxes(r.found.contact, r.found.joints); },
            nb::sig("def contact_boxes(self) -> " CHASLES_ARRAY),
            "Boxes in which something is proven to touch in each configuration, array (n, 2, joints).")
        .def_prop_ro(
            "open_boxes", [](const Range& r) { return array_of_boxes(r.found.open, r.found.joints); },
            nb::sig("def open_boxes(self) -> " CHASLES_ARRAY),
            "Boxes of which nothing is proven, array (n, 2, joints).")
        .def_prop_ro(
            "clear_share", [](const Range& r) { return r.found.clear_share; }, doc("RobotRange.clear_share"))
        .def_prop_ro(
            "contact_share", [](const Range& r) { return r.found.contact_share; },
            "The part of the box's volume that is proven to be in contact.")
        .def_prop_ro(
            "open_share", [](const Range& r) { return r.found.open_share; },
            "The part of the box's volume of which nothing is proven.")
        .def_prop_ro(
            "witness", [](const Range& r) { return r.found.witness ? array_of(*r.found.witness) : nb::none(); },
            nb::sig("def witness(self) -> " CHASLES_ARRAY " | None"), doc("RobotRange.witness"))
        .def_prop_ro(
            "pair", [](const Range& r) { return pair_of(r.found.pair); },
            nb::sig("def pair(self) -> tuple[str, str] | None"),
            "Two links or parts, or one and a body of the scene, that touch at the witness.")
        .def_prop_ro(
            "cells", [](const Range& r) { return r.found.cells; }, doc("RobotRange.cells"))
        .def_prop_ro(
            "untested", [](const Range& r) { return *r.found.untested; }, "What the answer does not look at.")
        .def("__repr__", [](const Range& r) {
            return fmt::format("<chasles.RobotRange: {}; {:.3g} % clear, {:.3g} % in contact, {:.3g} % open>",
                               view::name_of(r.found.verdict), 100 * r.found.clear_share, 100 * r.found.contact_share,
                               100 * r.found.open_share);
        });
}

void bind_clear_box(nb::module_& module) {
    using Box = PythonClearBox;
    nb::class_<Box>(module, "ClearBox", doc("ClearBox"))
        .def_prop_ro(
            "verdict", [](const Box& b) { return std::string(view::name_of(b.found.verdict)); },
            "'clear': in each configuration of the box the robot is proven to touch nothing. 'contact': the "
            "configuration itself touches something. 'open': that is not decided.")
        .def_prop_ro(
            "lower", [](const Box& b) { return array_of(b.found.box.lower); },
            nb::sig("def lower(self) -> " CHASLES_ARRAY), "The lower ends, array (variables,).")
        .def_prop_ro(
            "upper", [](const Box& b) { return array_of(b.found.box.upper); },
            nb::sig("def upper(self) -> " CHASLES_ARRAY), "The upper ends, array (variables,).")
        .def_prop_ro(
            "share", [](const Box& b) { return b.found.share; }, doc("ClearBox.share"))
        .def_prop_ro(
            "is_maximal", [](const Box& b) { return b.found.is_maximal; }, doc("ClearBox.is_maximal"))
        .def_prop_ro(
            "cells", [](const Box& b) { return b.found.cells; }, doc("ClearBox.cells"))
        .def_prop_ro(
            "untested", [](const Box& b) { return *b.found.untested; }, "What the answer does not look at.")
        .def("__repr__", [](const Box& b) {
            return fmt::format("<chasles.ClearBox: {}, {:.3g} % of the box>", view::name_of(b.found.verdict),
                               100 * b.found.share);
        });
}

constexpr const char* range_doc =
    "What is clear, in contact or open of all configurations of a box, proven.\n\nParameters\n----------\n"
    "lower, upper : array (variables,)\n    The ends of the box, as of `box_of_joints`. Variables with equal ends "
    "stand "
    "still.\nscene : Scene, optional\n    The world, whose bodies stand still; without it the robot itself only.\n"
    "margin : float\n    Distance that counts as contact, mesh unit.\ntolerance : float\n    The search ends once a "
    "witness is known and no more than this share of the box is open.\nseconds : float\n    What is not decided then "
    "is "
    "open.\nthreads : int\n    At most so many; 0: all cores. The answer is the same unless time ends the search.\n"
    "most_cells : int\n    So many boxes of configurations are examined; the rest is open.\n\nReturns\n-------\n"
    "RobotRange\n\nRaises\n------\nInvalidInput\n    For ends that make no box, and bodies of the scene that move.";

constexpr const char* clear_box_doc =
    "A large box around a configuration, within a given one, in which the robot is proven to touch nothing. It grows "
    "evenly first, then side by side; it is not the largest one of all.\n\nParameters\n----------\n"
    "lower, upper : array (variables,)\n    The ends of the given box, as of `box_of_joints`.\nscene : Scene, "
    "optional\n"
    "    The world, whose bodies stand still; without it the robot itself only.\naround : array (variables,), "
    "optional\n"
    "    The configuration; the middle of the given box if it is left out.\nmargin : float\n    Distance that counts "
    "as "
    "contact, mesh unit.\ntolerance : float\n    The part of the given box by which no side could be moved farther.\n"
    "seconds, threads, most_cells\n    As for `range`.\n\nReturns\n-------\nClearBox\n\nRaises\n------\nInvalidInput\n"
    "    As for `range`, and for a configuration outside of the box.";

#define CHASLES_RANGE_OPTIONS                                                                                          \
    "tolerance: float = 0.01, seconds: float = 60.0, threads: int = 0, most_cells: int = 1000000"

/// The ends of a variable without limits stand in the arrays, not in an argument.
ConfigurationBox box_with_way_out(const PythonRobot& robot, const std::vector<std::string>& joints,
                                  const Configuration& configuration) {
    try {
        return box_of_joints(robot, joints, configuration);
    } catch (const InvalidInput& error) {
        const std::string why = error.what();
        throw InvalidInput(why + (why.ends_with("give the ends of its range")
                                      ? ": leave it out here, and set them in the arrays lower and upper that come back"
                                      : ""));
    }
}

} // namespace

void bind_robot_ranges(nb::class_<PythonRobot>& type, nb::module_& module) {
    bind_range(module);
    bind_clear_box(module);
    type.def(
            "box_of_joints",
            [](const PythonRobot& robot, const std::vector<std::string>& joints, nb::handle configuration) {
                const ConfigurationBox box = box_with_way_out(
                    robot, joints,
                    configuration.is_none() ? robot.neutral() : configuration_from(configuration, "configuration"));
                return nb::make_tuple(array_of(box.lower), array_of(box.upper));
            },
            "joints"_a, "configuration"_a = nb::none(),
            nb::sig("def box_of_joints(self, joints: list[str], configuration: numpy.typing.ArrayLike | None = None) "
                    "-> tuple[" CHASLES_ARRAY ", " CHASLES_ARRAY "]"),
            doc("box_of_joints"))
        .def(
            "range",
            [](const PythonRobot& robot, nb::handle lower, nb::handle upper, nb::handle scene, double margin,
               double tolerance, double seconds, unsigned threads, std::size_t most_cells) {
                const Asking question = robot.asking();
                return range_of(checker_with(robot, scene, margin), box_from(lower, upper),
                                {tolerance, seconds, threads, most_cells});
            },
            "lower"_a.none(), "upper"_a.none(), "scene"_a = nb::none(), nb::kw_only(), "margin"_a = 0.0,
            "tolerance"_a = 0.01, "seconds"_a = 60.0, "threads"_a = 0, "most_cells"_a = 1'000'000,
            nb::sig("def range(self, lower: numpy.typing.ArrayLike, upper: numpy.typing.ArrayLike, scene: Scene | None "
                    "= None, *, margin: float = 0.0, " CHASLES_RANGE_OPTIONS ") -> RobotRange"),
            range_doc)
        .def(
            "clear_box",
            [](const PythonRobot& robot, nb::handle lower, nb::handle upper, nb::handle scene, nb::handle around,
               double margin, double tolerance, double seconds, unsigned threads, std::size_t most_cells) {
                const Asking question = robot.asking();
                return clear_box_of(checker_with(robot, scene, margin), box_from(lower, upper), around,
                                    {tolerance, seconds, threads, most_cells});
            },
            "lower"_a.none(), "upper"_a.none(), "scene"_a = nb::none(), nb::kw_only(), "around"_a = nb::none(),
            "margin"_a = 0.0, "tolerance"_a = 0.01, "seconds"_a = 60.0, "threads"_a = 0, "most_cells"_a = 1'000'000,
            nb::sig("def clear_box(self, lower: numpy.typing.ArrayLike, upper: numpy.typing.ArrayLike, scene: Scene | "
                    "None = None, *, around: numpy.typing.ArrayLike | None = None, margin: float = "
                    "0.0, " CHASLES_RANGE_OPTIONS ") -> ClearBox"),
            clear_box_doc);
}

} // namespace chasles::python
