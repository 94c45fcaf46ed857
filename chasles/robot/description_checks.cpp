#include "chasles/robot/description_checks.h"

#include "chasles/robot/model.h"

#include <algorithm>
#include <cmath>

namespace chasles::robot {

namespace {

void check_deviations(const LinkDescription& link) {
    for (const CollisionDescription& collision : link.collisions)
        if (!(collision.deviation >= 0) || !std::isfinite(collision.deviation))
            refuse(link.name, "deviation: must be at least 0, and finite");
}

template <class Items>
void require_name(const Items& items, const std::string& name, const std::string& user, const char* what) {
    using Item = typename Items::value_type;
    if (std::ranges::find(items, name, &Item::name) == items.end())
        refuse(user, std::string("there is no ") + what + ' ' + name);
}

void check_state(const RobotDescription& robot, const StateDescription& state) {
    for (const StateDescription::Value& value : state.values) {
        require_name(robot.joints, value.joint, state.name, "joint");
        const JointDescription& joint = *std::ranges::find(robot.joints, value.joint, &JointDescription::name);
        if (const std::size_t count = suffixes_of(joint.type).size(); value.values.size() != count)
            refuse(state.name, value.joint + ": needs " + std::to_string(count) + " values, and has " +
                                   std::to_string(value.values.size()));
        if (!std::ranges::all_of(value.values, [](double v) { return std::isfinite(v); }))
            refuse(state.name, value.joint + ": must be finite");
    }
}

} // namespace

void check(const JointDescription& joint) {
    const bool has_axis = joint.type != JointType::fixed && joint.type != JointType::floating;
    if (has_axis && (!joint.axis.allFinite() || !(joint.axis.cwiseAbs().maxCoeff() > 0)))
        refuse(joint.name, "axis: must be finite and not zero");
    if (std::isnan(joint.lower) || std::isnan(joint.upper) || joint.lower > joint.upper)
        refuse(joint.name, "limits: the lower one must not be above the upper one");
    if (!joint.mimic)
        return;
    if (!std::isfinite(joint.mimic->multiplier) || !std::isfinite(joint.mimic->offset))
        refuse(joint.name, "mimic: multiplier and offset must be finite");
    if (joint.type == JointType::planar || joint.type == JointType::floating)
        refuse(joint.name, "mimic: a joint with several variables cannot follow another one");
}

void check_parts(const RobotDescription& robot) {
    for (const LinkDescription& link : robot.links)
        check_deviations(link);
    for (const GroupDescription& group : robot.groups) {
        for (const std::string& joint : group.joints)
            require_name(robot.joints, joint, group.name, "joint");
        for (const std::string& link : group.links)
            require_name(robot.links, link, group.name, "link");
    }
    for (const StateDescription& state : robot.states)
        check_state(robot, state);
}

} // namespace chasles::robot
