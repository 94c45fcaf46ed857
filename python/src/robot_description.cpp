#include "python/src/robot_description.h"

#include "chasles/base/invalid_input.h"
#include "python/src/arrays.h"
#include "python/src/body.h"
#include "python/src/poses.h"
#include "view/names.h"

#include <algorithm>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace chasles::python {
namespace {

using Texts = std::vector<std::string>;

/// "joints[2]: WHY", of an item, and "origin: WHY", also of a reason that names the origin already.
std::string placed(const std::string& where, const std::string& why) {
    return why.starts_with('[') ? where + why : why.starts_with(where + ": ") ? why : where + ": " + why;
}

/// What `read` returns. Its errors are about WHERE.
template <class Read>
auto placed_at(const std::string& where, const Read& read) {
    try {
        return read();
    } catch (const InvalidInput& error) {
        throw InvalidInput(placed(where, error.what()));
    } catch (const nb::builtin_exception& error) {
        throw nb::type_error(placed(where, error.what()).c_str());
    }
}

template <class Value>
Value value_of(nb::handle given, const char* what) {
    Value value{};
    if (!nb::try_cast(given, value))
        throw nb::type_error(("must be " + std::string(what) + ", not " + text_of_argument(given)).c_str());
    return value;
}

std::string text_of_name(nb::handle given) {
    return value_of<std::string>(given, "a str");
}

double number_of(nb::handle given) {
    return value_of<double>(given, "a number");
}

/// What `make` makes of each item of a list, or of a tuple.
template <class Make>
auto items_of(nb::handle list, const Make& make) {
    std::vector<decltype(make(list))> items;
    if (!nb::isinstance<nb::list>(list) && !nb::isinstance<nb::tuple>(list))
        throw nb::type_error(("must be a list, not " + text_of_argument(list)).c_str());
    for (const nb::handle item : list)
        items.push_back(placed_at("[" + std::to_string(items.size()) + "]", [&] { return make(item); }));
    return items;
}

Texts names_in(nb::handle list) {
    return items_of(list, text_of_name);
}

/// A dict whose keys are known.
class Entry {
public:
    Entry(nb::handle given, const Texts& keys) : keys_(keys) {
        if (!nb::isinstance<nb::dict>(given))
            throw nb::type_error(("must be a dict with " + listed() + ", not " + text_of_argument(given)).c_str());
        dict_ = nb::borrow<nb::dict>(given);
        for (const auto& [key, value] : dict_)
            if (const std::string name = nb::str(key).c_str(); std::ranges::find(keys, name) == keys.end())
                throw InvalidInput("the key '" + name + "' is unknown; there are " + listed());
    }

    /// Leaves the field as it is where the key is left out. `read` may want the name of the value.
    template <class Field, class Read>
    void read(const char* key, Field& field, const Read& read) const {
        if (!dict_.contains(key))
            return;
        const nb::object value(dict_[key]);
        field = placed_at(key, [&] {
            if constexpr (std::is_invocable_v<Read, nb::handle, const char*>)
                return read(value, key);
            else
                return read(value);
        });
    }
    [[nodiscard]] std::string name(const char* key = "name") const {
        if (!dict_.contains(key))
            throw InvalidInput("has no '" + std::string(key) + "'");
        return placed_at(key, [&] { return text_of_name(nb::object(dict_[key])); });
    }

private:
    [[nodiscard]] std::string listed() const {
        std::string text;
        for (const std::string& key : keys_)
            text += (text.empty() ? "" : ", ") + key;
        return text;
    }

    const Texts& keys_;
    nb::dict dict_;
};

/// A polyhedron alone stands for a shape in the frame of its link.
CollisionDescription collision_of(nb::handle given) {
    static const Texts keys{"shape", "origin", "deviation"};
    if (nb::isinstance<Body>(given))
        return {polyhedron_of(given, "shape")};
    const Entry entry(given, keys);
    std::optional<Polyhedron> shape;
    entry.read("shape", shape, polyhedron_of);
    if (!shape)
        throw InvalidInput("has no 'shape'");
    CollisionDescription collision{*shape};
    entry.read("origin", collision.origin, pose_from);
    entry.read("deviation", collision.deviation, number_of);
    return collision;
}

LinkDescription link_of(nb::handle given) {
    static const Texts keys{"name", "collisions"};
    const Entry entry(given, keys);
    LinkDescription link{entry.name()};
    entry.read("collisions", link.collisions, [](nb::handle list) { return items_of(list, collision_of); });
    return link;
}

JointType type_of(nb::handle given) {
    const std::string name = text_of_name(given);
    std::string names;
    for (const JointType type : {JointType::fixed, JointType::revolute, JointType::continuous, JointType::prismatic,
                                 JointType::planar, JointType::floating}) {
        if (name == view::name_of(type))
            return type;
        names += (names.empty() ? "" : ", ") + std::string(view::name_of(type));
    }
    throw InvalidInput("must be one of " + names + ", not '" + name + "'");
}

MimicDescription mimic_of(nb::handle given) {
    static const Texts keys{"joint", "multiplier", "offset"};
    const Entry entry(given, keys);
    MimicDescription mimic{entry.name("joint")};
    entry.read("multiplier", mimic.multiplier, number_of);
    entry.read("offset", mimic.offset, number_of);
    return mimic;
}

JointDescription joint_of(nb::handle given) {
    static const Texts keys{"name", "type", "parent", "child", "origin", "axis", "lower", "upper", "mimic"};
    const Entry entry(given, keys);
    JointDescription joint{entry.name()};
    joint.parent = entry.name("parent");
    joint.child = entry.name("child");
    entry.read("type", joint.type, type_of);
    entry.read("origin", joint.origin, pose_from);
    entry.read("axis", joint.axis, vector_from);
    entry.read("lower", joint.lower, number_of);
    entry.read("upper", joint.upper, number_of);
    entry.read("mimic", joint.mimic, [](nb::handle mimic) {
        return mimic.is_none() ? std::optional<MimicDescription>() : std::optional(mimic_of(mimic));
    });
    return joint;
}

/// Two names, and a reason if there is one.
LinkPairDescription pair_of(nb::handle given) {
    const Texts texts = names_in(given);
    if (texts.size() != 2 && texts.size() != 3)
        throw InvalidInput("must be two names of links, or two and a reason");
    return {texts[0], texts[1], texts.size() == 3 ? texts[2] : ""};
}

GroupDescription group_of(nb::handle given) {
    static const Texts keys{"name", "joints", "links"};
    const Entry entry(given, keys);
    GroupDescription group{entry.name()};
    entry.read("joints", group.joints, names_in);
    entry.read("links", group.links, names_in);
    return group;
}

/// A dict of the value of each joint, or of the list of its values.
std::vector<StateDescription::Value> values_of(nb::handle given) {
    std::vector<StateDescription::Value> values;
    for (const auto& [joint, value] : value_of<nb::dict>(given, "a dict"))
        values.push_back({text_of_name(joint), nb::isinstance<nb::list>(value) ? items_of(value, number_of)
                                                                               : std::vector{number_of(value)}});
    return values;
}

StateDescription state_of(nb::handle given) {
    static const Texts keys{"name", "group", "values"};
    const Entry entry(given, keys);
    StateDescription state{entry.name()};
    entry.read("group", state.group, text_of_name);
    entry.read("values", state.values, values_of);
    return state;
}

/// A list with what `make` makes of each item.
template <class Items, class Make>
nb::list list_of(const Items& items, const Make& make) {
    nb::list list;
    for (const auto& item : items)
        list.append(make(item));
    return list;
}

/// The keys and the values in turns.
template <class... Pairs>
nb::dict dict_with(const Pairs&... pairs) {
    nb::dict dict;
    ((dict[pairs.first] = pairs.second), ...);
    return dict;
}

nb::dict dict_of(const CollisionDescription& collision) {
    return dict_with(std::pair("shape", nb::cast(Body{collision.shape})),
                     std::pair("origin", numbers_of(collision.origin)), std::pair("deviation", collision.deviation));
}

nb::dict dict_of(const LinkDescription& link) {
    const auto collisions =
        list_of(link.collisions, [](const CollisionDescription& collision) { return dict_of(collision); });
    return dict_with(std::pair("name", link.name), std::pair("collisions", collisions));
}

nb::dict dict_of(const JointDescription& joint) {
    nb::dict dict = dict_with(std::pair("name", joint.name), std::pair("type", std::string(view::name_of(joint.type))),
                              std::pair("parent", joint.parent), std::pair("child", joint.child),
                              std::pair("origin", numbers_of(joint.origin)), std::pair("axis", array_of(joint.axis)),
                              std::pair("lower", joint.lower), std::pair("upper", joint.upper));
    if (joint.mimic)
        dict["mimic"] =
            dict_with(std::pair("joint", joint.mimic->joint), std::pair("multiplier", joint.mimic->multiplier),
                      std::pair("offset", joint.mimic->offset));
    else
        dict["mimic"] = nb::none();
    return dict;
}

nb::dict dict_of(const GroupDescription& group) {
    return dict_with(std::pair("name", group.name), std::pair("joints", group.joints), std::pair("links", group.links));
}

nb::dict dict_of(const StateDescription& state) {
    nb::dict values;
    for (const StateDescription::Value& value : state.values)
        values[value.joint.c_str()] = value.values;
    return dict_with(std::pair("name", state.name), std::pair("group", state.group), std::pair("values", values));
}

nb::tuple tuple_of(const LinkPairDescription& pair) {
    return nb::make_tuple(pair.first, pair.second, pair.reason);
}

} // namespace

RobotDescription description_from(nb::handle dict) {
    static const Texts keys{"name",          "links",  "joints", "disabled_pairs",
                            "enabled_pairs", "groups", "states", "warnings"};
    return placed_at("robot", [&] {
        const Entry entry(dict, keys);
        const auto listed = [](const auto& make) { return [make](nb::handle list) { return items_of(list, make); }; };
        RobotDescription robot;
        entry.read("name", robot.name, text_of_name);
        entry.read("links", robot.links, listed(link_of));
        entry.read("joints", robot.joints, listed(joint_of));
        entry.read("disabled_pairs", robot.disabled_pairs, listed(pair_of));
        entry.read("enabled_pairs", robot.enabled_pairs, listed(pair_of));
        entry.read("groups", robot.groups, listed(group_of));
        entry.read("states", robot.states, listed(state_of));
        entry.read("warnings", robot.warnings, names_in);
        return robot;
    });
}

nb::dict dict_of(const RobotDescription& robot) {
    const auto listed = [](const auto& items) {
        return list_of(items, [](const auto& item) { return dict_of(item); });
    };
    return dict_with(
        std::pair("name", robot.name), std::pair("links", listed(robot.links)),
        std::pair("joints", listed(robot.joints)), std::pair("disabled_pairs", list_of(robot.disabled_pairs, tuple_of)),
        std::pair("enabled_pairs", list_of(robot.enabled_pairs, tuple_of)), std::pair("groups", listed(robot.groups)),
        std::pair("states", listed(robot.states)), std::pair("warnings", robot.warnings));
}

} // namespace chasles::python
