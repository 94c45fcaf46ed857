// chasles.RobotClearance, and questions about how near a robot comes.
#include "chasles/base/invalid_input.h"
#include "chasles/base/number_text.h"
#include "python/src/answer.h"
#include "python/src/docstrings.h"
#include "python/src/robot.h"
#include "view/stamped_speeds.h"

#include <array>
#include <fmt/format.h>
#include <nanobind/stl/string.h>

namespace chasles::python {

namespace {

std::string summary(const PythonClearance& clearance) {
    const RobotClearance& found = clearance.found;
    if (!found.pair)
        return found.certain
                   ? "<chasles.RobotClearance: no two bodies are tested>"
                   : "<chasles.RobotClearance: unknown: the limit was reached before two bodies were searched>";
    const std::string distance = found.distance.upper > 0 ? fmt::format("{:.9g}", found.distance.lower) : "0, touching";
    return fmt::format("<chasles.RobotClearance: {}{}, {} to {} at time {} of segment {}>", distance,
                       found.certain ? "" : doubt_about(found.distance), found.pair->first, found.pair->second,
                       time_text(clearance.time().lower), found.segment);
}

} // namespace

PythonClearance clearance_on_edge(const RobotChecker& checker, nb::handle start, nb::handle goal, double tolerance) {
    const auto [from, to] = edge_from(start, goal);
    JointPath path = JointPath::straight(checker.robot(), std::array{from, to});
    RobotClearance found = asked([&] { return checker.least_distance(path, {.tolerance = tolerance}); });
    return {std::move(found), checker, std::move(path)};
}

PythonClearance clearance_on_path(const RobotChecker& checker, const PathArguments& arguments, double tolerance) {
    JointPath path = path_from(checker.robot(), arguments);
    const std::vector<Handover> handovers = handovers_from(arguments);
    RobotClearance found = asked([&] { return checker.least_distance(path, {.tolerance = tolerance}, handovers); });
    const bool in_stamps = has_stamps(arguments);
    if (in_stamps)
        view::count_in_stamps(found.nearest.contacts, view::duration_of(path, found.segment));
    return {std::move(found), checker, std::move(path), in_stamps, !handovers.empty()};
}

namespace {

RobotGradient gradient_of(const PythonClearance& c) {
    if (c.has_handovers)
        throw InvalidInput("gradient: is not computed for a path with handovers");
    return c.gradient.get([&] { return c.checker.least_distance_gradient(c.path, c.found); });
}

/// Rows of knots.
nb::object rows_of(const Eigen::MatrixXd& by_knots) {
    if (by_knots.size() == 0)
        return nb::none();
    const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> rows = by_knots;
    return array_of(std::span(rows.data(), std::size_t(rows.size())),
                    {std::size_t(rows.rows()), std::size_t(rows.cols())});
}

void bind_gradient(nb::class_<PythonClearance>& type) {
    type.def_prop_ro(
            "gradient", [](const PythonClearance& c) { return rows_of(gradient_of(c).by_knots); },
            nb::sig("def gradient(self) -> " CHASLES_ARRAY " | None"),
            "The derivatives of the least distance by the configurations of the path, shape (knots, variables); of an "
            "edge (2, variables),\nso that gradient[-1] is that of the goal. Mesh unit per radian, or per mesh unit. "
            "Times stay, and so do velocities that were\ngiven with the configurations. None where something touches. "
            "It is that of this minimum only if `isolated`. Computed in\ndouble on the first use.\n\n"
            "Raises\n------\nInvalidInput\n    For a path of polynomials or of several robots, which has no knots, and "
            "with handovers.")
        .def_prop_ro(
            "isolated", [](const PythonClearance& c) { return gradient_of(c).isolated; },
            doc("DistanceGradient.isolated"));
}

} // namespace

void bind_robot_clearance(nb::module_& module) {
    using Clearance = PythonClearance;
    nb::class_<Clearance> type(module, "RobotClearance", doc("RobotClearance"));
    bind_gradient(type);
    type.def_prop_ro(
            "distance", [](const Clearance& c) { return c.found.distance.lower; },
            "Lower end of the bracket around the least distance. It is proven: nothing comes nearer. Mesh unit; 0 if "
            "something touches, infinite if no two bodies are tested.")
        .def_prop_ro(
            "distance_upper", [](const Clearance& c) { return c.found.distance.upper; },
            "Upper end of the bracket around the least distance.")
        .def_prop_ro(
            "segment", [](const Clearance& c) { return c.found.segment; }, "Of the least distance.")
        .def_prop_ro(
            "time", [](const Clearance& c) { return c.time().lower; },
            "When the pair is as near as `distance_upper`: within the segment, in [0, 1], or in stamps. Of the first "
            "contact in the segment if something touches.")
        .def_prop_ro(
            "time_upper", [](const Clearance& c) { return c.time().upper; }, "Upper end of the bracket of the time.")
        .def_prop_ro(
            "certain", [](const Clearance& c) { return c.found.certain; }, doc("RobotClearance.certain"))
        .def_prop_ro(
            "pair", [](const Clearance& c) { return pair_of(c.found.pair); },
            nb::sig("def pair(self) -> tuple[str, str] | None"),
            "Two links or parts, or one and a body of the scene, that are nearest.")
        .def_prop_ro(
            "contacts", [](const Clearance& c) { return tuple_of(c.found.nearest.contacts); },
            nb::sig("def contacts(self) -> tuple[Contact, ...]"),
            "The nearest features at `time`, in the world; the first one of the pair moves. Speeds are per unit of "
            "`time`.")
        .def_prop_ro(
            "configuration",
            [](const Clearance& c) { return c.found.pair ? array_of(c.found.configuration) : nb::none(); },
            nb::sig("def configuration(self) -> " CHASLES_ARRAY " | None"), "At `time`.")
        .def_prop_ro(
            "untested", [](const Clearance& c) { return *c.found.untested; }, "What the answer does not look at.")
        .def_prop_ro(
            "pairs", [](const Clearance& c) { return c.found.pairs; }, doc("RobotClearance.pairs"))
        .def_prop_ro(
            "work", [](const Clearance& c) { return c.found.work; }, doc("Work"))
        .def("__repr__", [](const Clearance& c) { return summary(c); });
}

} // namespace chasles::python
