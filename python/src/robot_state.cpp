// Robots of arrays, and back; robots for pickle; and a robot that is one free body.
#include "chasles/base/invalid_input.h"
#include "python/src/body.h"
#include "python/src/poses.h"
#include "python/src/robot.h"
#include "python/src/robot_description.h"

#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

namespace chasles::python {
namespace {

using namespace nb::literals;

nb::object shape_of(const Polyhedron& shape) {
    return nb::cast(Body{shape});
}

Pose pose_of(nb::handle numbers) {
    return pose_from(numbers, "pose");
}

template <class Value>
Value value_of(nb::handle item) {
    return nb::cast<Value>(item);
}

using Texts = std::vector<std::string>;

nb::tuple state_of(const AttachedPart& part) {
    return nb::make_tuple(part.name, part.link, shape_of(part.shape), numbers_of(part.pose), part.touch_links);
}

AttachedPart part_of(const nb::tuple& state) {
    return {value_of<std::string>(state[0]), value_of<std::string>(state[1]), polyhedron_of(state[2], "shape"),
            pose_of(state[3]), value_of<Texts>(state[4])};
}

/// What makes the robot anew: its description, and its changes since.
nb::tuple state_of_robot(const PythonRobot& robot) {
    const RobotChanges changes = robot.changes();
    nb::list parts;
    for (const AttachedPart& part : changes.parts)
        parts.append(state_of(part));
    return nb::make_tuple(dict_of(robot.description()), numbers_of(changes.base), parts, nb::cast(changes.ignored),
                          nb::cast(changes.ignored_in_scene), nb::cast(changes.margins));
}

void set_state(PythonRobot& robot, const nb::tuple& state) {
    if (state.size() != 6)
        throw InvalidInput("state: is not that of a robot");
    RobotChanges changes{pose_of(state[1])};
    for (const nb::handle part : state[2])
        changes.parts.push_back(part_of(nb::cast<nb::tuple>(part)));
    changes.ignored = value_of<std::vector<RobotChanges::Names>>(state[3]);
    changes.ignored_in_scene = value_of<std::vector<RobotChanges::Names>>(state[4]);
    changes.margins = value_of<std::vector<std::pair<RobotChanges::Names, double>>>(state[5]);
    new (&robot) PythonRobot(Robot(description_from(state[0]), changes));
}

/// A robot of the arguments of a call, which are named like the keys of a description.
void make_robot(PythonRobot* robot, const nb::kwargs& description) {
    new (robot) PythonRobot(Robot(description_from(description)));
}

/// The robot of chasles/ompl.h: a body on one floating joint.
PythonRobot free_body(nb::handle shape, const std::string& name) {
    RobotDescription robot{name};
    robot.links = {{"world"}, {name, {{polyhedron_of(shape, "shape")}}}};
    robot.joints = {{"free", JointType::floating, "world", name}};
    return Robot(std::move(robot));
}

#define CHASLES_DICTS "collections.abc.Sequence[dict[str, Any]] = []"
#define CHASLES_PAIRS "collections.abc.Sequence[collections.abc.Sequence[str]] = []"

const nb::sig robot_signature("def __init__(self, *, links: " CHASLES_DICTS ", joints: " CHASLES_DICTS
                              ", name: str = '', disabled_pairs: " CHASLES_PAIRS ", enabled_pairs: " CHASLES_PAIRS
                              ", groups: " CHASLES_DICTS ", states: " CHASLES_DICTS
                              ", warnings: collections.abc.Sequence[str] = []) -> None");

constexpr const char* robot_doc =
    "A robot of links and joints. Each item is a dict with these keys; those with `=` may be left out.\n\n"
    "Parameters\n----------\n"
    "links : list of dict\n    `name`; `collisions=[]`: a Polyhedron each, or a dict of `shape`, `origin=` its pose in "
    "the frame of the link,\n    (4, 4) or (7,), and `deviation=0.0`: by how much it encloses a round body.\n"
    "joints : list of dict\n    `name`, `parent`, `child`: two links; `type='fixed'`, 'revolute', 'continuous', "
    "'prismatic', 'planar' or 'floating';\n    `origin=` the pose of its frame in that of the parent; `axis=(1, 0, 0)` "
    "in its own frame; `lower=-inf`, `upper=inf`:\n    radians, or the mesh unit; `mimic=None`, or a dict of `joint`, "
    "`multiplier=1`, `offset=0`: whose value it follows.\n"
    "name : str\n    Of the robot.\n"
    "disabled_pairs, enabled_pairs : list of (str, str) or (str, str, str)\n    Two links and a reason: pairs that are "
    "not tested, besides links that a joint connects; and pairs that are, in spite\n    of that.\n"
    "groups : list of dict\n    `name`, `joints=[]`, `links=[]`: names that belong together.\n"
    "states : list of dict\n    `name`, `group=''`, `values={}`: of each joint a number, or a list for a joint with "
    "several: see `Robot.state`.\n"
    "warnings : list of str\n    What `Robot.warnings` says.\n\n"
    "Raises\n------\nInvalidInput\n    For links and joints that are no tree, unknown names and keys, and names that "
    "come twice.\nTypeError\n    For values of another type.";

} // namespace

void bind_robot_state(nb::class_<PythonRobot>& type, nb::module_& module) {
    type.def("__init__", make_robot, robot_signature, robot_doc)
        .def(
            "description", [](const PythonRobot& robot) { return dict_of(robot.description()); },
            nb::sig("def description(self) -> dict[str, Any]"),
            "The arguments that make this robot: `Robot(**robot.description())` is the same one, bit for bit, without "
            "what has been\nchanged since (`set_base`, `attach`, `ignore`, `test`, `set_margin`). Every key is there; "
            "poses are seven numbers.")
        .def("__getstate__", state_of_robot)
        .def("__setstate__", set_state)
        .def(
            "__copy__", [](const PythonRobot& robot) { return PythonRobot(robot); },
            nb::sig("def __copy__(self) -> Robot"), "A robot that can be changed by itself. It shares the shapes.");
    module.def("_free_body", free_body, "shape"_a.none(), "name"_a = "body",
               nb::sig("def _free_body(shape: Polyhedron, name: str = 'body') -> Robot"),
               "See `chasles.ompl.free_body`.");
}

} // namespace chasles::python
