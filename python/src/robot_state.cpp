// Robots for pickle, as tuples of names, numbers and polyhedra; and a robot that is one free body.
#include "chasles/base/invalid_input.h"
#include "python/src/body.h"
#include "python/src/poses.h"
#include "python/src/robot.h"

#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

namespace chasles::python {
namespace {

using namespace nb::literals;

/// A list with what `make` makes of each item.
template <class Items, class Make>
nb::list list_of(const Items& items, const Make& make) {
    nb::list list;
    for (const auto& item : items)
        list.append(make(item));
    return list;
}

/// The inverse: from a Python list.
template <class Item, class Make>
std::vector<Item> items_of(nb::handle list, const Make& make) {
    std::vector<Item> items;
    for (const nb::handle item : list)
        items.push_back(make(nb::cast<nb::tuple>(item)));
    return items;
}

nb::object shape_of(const Polyhedron& shape) {
    return nb::cast(Body{shape, nullptr, {}});
}

Pose pose_of(nb::handle numbers) {
    return pose_from(numbers, "pose");
}

template <class Value>
Value value_of(nb::handle item) {
    return nb::cast<Value>(item);
}

using Texts = std::vector<std::string>;

nb::tuple state_of(const LinkDescription& link) {
    return nb::make_tuple(link.name, list_of(link.collisions, [](const CollisionDescription& c) {
                              return nb::make_tuple(shape_of(c.shape), numbers_of(c.origin), c.deviation);
                          }));
}

LinkDescription link_of(const nb::tuple& state) {
    return {value_of<std::string>(state[0]), items_of<CollisionDescription>(state[1], [](const nb::tuple& c) {
                return CollisionDescription{polyhedron_of(c[0], "shape"), pose_of(c[1]), value_of<double>(c[2])};
            })};
}

nb::tuple state_of(const JointDescription& joint) {
    const nb::object mimic =
        joint.mimic ? nb::object(nb::make_tuple(joint.mimic->joint, joint.mimic->multiplier, joint.mimic->offset))
                    : nb::object(nb::none());
    return nb::make_tuple(joint.name, int(joint.type), joint.parent, joint.child, numbers_of(joint.origin),
                          array_of(joint.axis), joint.lower, joint.upper, mimic);
}

JointDescription joint_of(const nb::tuple& state) {
    JointDescription joint{value_of<std::string>(state[0]), JointType(value_of<int>(state[1])),
                           value_of<std::string>(state[2]), value_of<std::string>(state[3]), pose_of(state[4])};
    joint.axis = vector_from(state[5], "axis");
    joint.lower = value_of<double>(state[6]);
    joint.upper = value_of<double>(state[7]);
    if (!state[8].is_none()) {
        const auto mimic = value_of<nb::tuple>(state[8]);
        joint.mimic = {value_of<std::string>(mimic[0]), value_of<double>(mimic[1]), value_of<double>(mimic[2])};
    }
    return joint;
}

nb::tuple state_of(const LinkPairDescription& pair) {
    return nb::make_tuple(pair.first, pair.second, pair.reason);
}

LinkPairDescription pair_of(const nb::tuple& state) {
    return {value_of<std::string>(state[0]), value_of<std::string>(state[1]), value_of<std::string>(state[2])};
}

nb::tuple state_of(const GroupDescription& group) {
    return nb::make_tuple(group.name, group.joints, group.links);
}

GroupDescription group_of(const nb::tuple& state) {
    return {value_of<std::string>(state[0]), value_of<Texts>(state[1]), value_of<Texts>(state[2])};
}

nb::tuple state_of(const StateDescription& state) {
    return nb::make_tuple(state.name, state.group, list_of(state.values, [](const StateDescription::Value& v) {
                              return nb::make_tuple(v.joint, v.values);
                          }));
}

StateDescription named_state_of(const nb::tuple& state) {
    return {value_of<std::string>(state[0]), value_of<std::string>(state[1]),
            items_of<StateDescription::Value>(state[2], [](const nb::tuple& v) {
                return StateDescription::Value{value_of<std::string>(v[0]), value_of<std::vector<double>>(v[1])};
            })};
}

nb::tuple state_of(const AttachedPart& part) {
    return nb::make_tuple(part.name, part.link, shape_of(part.shape), numbers_of(part.pose), part.touch_links);
}

AttachedPart part_of(const nb::tuple& state) {
    return {value_of<std::string>(state[0]), value_of<std::string>(state[1]), polyhedron_of(state[2], "shape"),
            pose_of(state[3]), value_of<Texts>(state[4])};
}

nb::tuple state_of_robot(const PythonRobot& robot) {
    const RobotDescription& d = robot.description();
    const auto states = [](const auto& items) { return list_of(items, [](const auto& i) { return state_of(i); }); };
    const RobotChanges changes = robot.changes();
    return nb::make_tuple(d.name, states(d.links), states(d.joints), states(d.disabled_pairs), states(d.enabled_pairs),
                          states(d.groups), states(d.states), numbers_of(changes.base), states(changes.parts),
                          nb::cast(changes.ignored), nb::cast(changes.ignored_in_scene), nb::cast(changes.margins),
                          nb::cast(d.warnings));
}

void set_state(PythonRobot& robot, const nb::tuple& state) {
    if (state.size() != 13)
        throw InvalidInput("state: is not that of a robot");
    RobotDescription d{value_of<std::string>(state[0])};
    d.links = items_of<LinkDescription>(state[1], link_of);
    d.joints = items_of<JointDescription>(state[2], joint_of);
    d.disabled_pairs = items_of<LinkPairDescription>(state[3], pair_of);
    d.enabled_pairs = items_of<LinkPairDescription>(state[4], pair_of);
    d.groups = items_of<GroupDescription>(state[5], group_of);
    d.states = items_of<StateDescription>(state[6], named_state_of);
    d.warnings = value_of<Texts>(state[12]);
    RobotChanges changes{pose_of(state[7]), items_of<AttachedPart>(state[8], part_of)};
    changes.ignored = value_of<std::vector<RobotChanges::Names>>(state[9]);
    changes.ignored_in_scene = value_of<std::vector<RobotChanges::Names>>(state[10]);
    changes.margins = value_of<std::vector<std::pair<RobotChanges::Names, double>>>(state[11]);
    new (&robot) PythonRobot(Robot(std::move(d), changes));
}

/// The robot of chasles/ompl.h: a body on one floating joint.
PythonRobot free_body(nb::handle shape, const std::string& name) {
    RobotDescription robot{name};
    robot.links = {{"world"}, {name, {{polyhedron_of(shape, "shape")}}}};
    robot.joints = {{"free", JointType::floating, "world", name}};
    return Robot(std::move(robot));
}

} // namespace

void bind_robot_state(nb::class_<PythonRobot>& type, nb::module_& module) {
    type.def("__getstate__", state_of_robot)
        .def("__setstate__", set_state)
        .def(
            "__copy__", [](const PythonRobot& robot) { return PythonRobot(robot); },
            nb::sig("def __copy__(self) -> Robot"), "A robot that can be changed by itself. It shares the shapes.");
    module.def("_free_body", free_body, "shape"_a.none(), "name"_a = "body",
               nb::sig("def _free_body(shape: Polyhedron, name: str = 'body') -> Robot"),
               "See `chasles.ompl.free_body`.");
}

} // namespace chasles::python
