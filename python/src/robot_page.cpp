// The page of a robot on its path.
#include "python/src/query_options.h"
#include "python/src/robot.h"
#include "python/src/scene.h"
#include "view/page.h"
#include "view/robot_record.h"

#include <nanobind/stl/string.h>

namespace chasles::python {
namespace {

using namespace nb::literals;

/// A page of HTML that shows the robot on a path up to its first contact.
std::string page_of(const PythonRobot& robot, nb::handle configurations, nb::handle scene, double margin,
                    const std::string& title, bool curve, nb::handle handovers) {
    const Asking question = robot.asking();
    const PathArguments arguments{configurations, nb::none(), nb::none(), nb::none(), handovers};
    const JointPath path = path_from(robot, arguments);
    const std::vector<Handover> changes = handovers_from(arguments);
    const nb::str find("first");
    const RobotChecker checker = checker_of(robot, {scene, margin, std::nullopt, default_time_tolerance, find});
    const PythonScene* const world = scene.is_none() ? nullptr : &nb::cast<const PythonScene&>(scene);
    std::optional<Asking> about_world;
    if (world)
        about_world.emplace(world->use, "scene");
    const RobotAnswer found = asked([&] { return checker.first_contact(path, changes); });
    std::optional<view::Curve> shown_curve;
    if (curve)
        shown_curve = asked([&] { return view::curve_of(checker, path, margin, changes); });
    const WithoutGil without_gil;
    view::SceneRecord record = view::robot_record(robot, world ? &world->scene : nullptr, {path, found, changes});
    record.margin = margin;
    record.curve = std::move(shown_curve);
    record.title = title;
    return view::scene_page(record);
}

} // namespace

void bind_robot_page(nb::module_& module) {
    module.def("robot_page", page_of, "robot"_a, "configurations"_a, "scene"_a.none(), "margin"_a, "title"_a, "curve"_a,
               "handovers"_a, "A page of HTML in UTF-8 that shows the robot on its way.");
}

} // namespace chasles::python
