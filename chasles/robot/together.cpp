// Several robots as one: their trees below one root, with the name of a robot in front of each of its names.
// Source: docs/derivations/42-several-robots.md.
#include "chasles/robot/model.h"
#include "chasles/robot/robot.h"

#include <iterator>
#include <set>

namespace chasles {

namespace {

/// The root of all robots. No other link has this name, as all others have a slash.
constexpr const char* root_of_cell = "world";

/// Puts the name of a robot and a slash in front of names.
class Prefix {
public:
    explicit Prefix(const std::string& robot) : prefix_(robot + '/') {}

    [[nodiscard]] std::string of(const std::string& name) const { return prefix_ + name; }
    [[nodiscard]] std::vector<std::string> of(std::vector<std::string> names) const {
        for (std::string& name : names)
            name = of(name);
        return names;
    }
    [[nodiscard]] RobotChanges::Names of(const RobotChanges::Names& pair) const {
        return {of(pair.first), of(pair.second)};
    }
    [[nodiscard]] LinkDescription of(LinkDescription link) const {
        link.name = of(link.name);
        return link;
    }
    [[nodiscard]] JointDescription of(JointDescription joint) const {
        for (std::string* const name : {&joint.name, &joint.parent, &joint.child})
            *name = of(*name);
        if (joint.mimic)
            joint.mimic->joint = of(joint.mimic->joint);
        return joint;
    }
    [[nodiscard]] LinkPairDescription of(const LinkPairDescription& pair) const {
        return {of(pair.first), of(pair.second), pair.reason};
    }
    [[nodiscard]] GroupDescription of(const GroupDescription& group) const {
        return {of(group.name), of(group.joints), of(group.links)};
    }
    [[nodiscard]] StateDescription of(StateDescription state) const {
        state.name = of(state.name);
        state.group = state.group.empty() ? "" : of(state.group);
        for (StateDescription::Value& value : state.values)
            value.joint = of(value.joint);
        return state;
    }
    [[nodiscard]] AttachedPart of(AttachedPart part) const {
        part.name = of(part.name);
        part.link = of(part.link);
        part.touch_links = of(std::move(part.touch_links));
        return part;
    }

    template <class Item>
    void append(std::vector<Item>& all, const std::vector<Item>& items) const {
        for (const Item& item : items)
            all.push_back(of(item));
    }

private:
    std::string prefix_;
};

const std::string& root_of(const RobotDescription& robot) {
    std::set<std::string> children;
    for (const JointDescription& joint : robot.joints)
        children.insert(joint.child);
    return std::ranges::find_if(robot.links, [&](const LinkDescription& l) { return !children.contains(l.name); })
        ->name;
}

void add_description(RobotDescription& cell, const std::string& name, const RobotDescription& robot, const Pose& base) {
    const Prefix prefix(name);
    cell.name += (cell.name.empty() ? "" : ", ") + name;
    cell.joints.push_back({name, JointType::fixed, root_of_cell, prefix.of(root_of(robot)), base});
    prefix.append(cell.links, robot.links);
    prefix.append(cell.joints, robot.joints);
    prefix.append(cell.disabled_pairs, robot.disabled_pairs);
    prefix.append(cell.enabled_pairs, robot.enabled_pairs);
    prefix.append(cell.groups, robot.groups);
    prefix.append(cell.states, robot.states);
    for (const std::string& warning : robot.warnings)
        cell.warnings.push_back(name + ": " + warning);
}

void add_changes(RobotChanges& cell, const std::string& name, const RobotChanges& robot) {
    const Prefix prefix(name);
    prefix.append(cell.parts, robot.parts);
    prefix.append(cell.ignored, robot.ignored);
    for (const auto& [link, body] : robot.ignored_in_scene)
        cell.ignored_in_scene.emplace_back(prefix.of(link), body);
    for (const auto& [pair, margin] : robot.margins)
        cell.margins.emplace_back(prefix.of(pair), margin);
}

void check_names(const std::vector<std::pair<std::string, Robot>>& robots) {
    if (robots.empty())
        robot::refuse("together", "there is no robot");
    std::set<std::string> names;
    for (std::size_t i = 0; i < robots.size(); ++i) {
        const std::string& name = robots[i].first;
        if (name.empty())
            robot::refuse("together", "robot " + std::to_string(i) + " has no name");
        if (name.find('/') != std::string::npos)
            robot::refuse("together", name + ": the name of a robot has no slash: one follows it in all names");
        if (!names.insert(name).second)
            robot::refuse("together", name + ": two robots have this name");
    }
}

} // namespace

Robot Robot::together(const std::vector<std::pair<std::string, Robot>>& robots) {
    check_names(robots);
    RobotDescription description;
    description.links = {{root_of_cell}};
    RobotChanges changes;
    for (const auto& [name, robot] : robots) {
        add_description(description, name, robot.description(), robot.base());
        add_changes(changes, name, robot.changes());
    }
    return {std::move(description), changes};
}

} // namespace chasles
