// Source of the messages: moveit_msgs (RobotState, DisplayTrajectory, GetCartesianPath, MotionSequenceResponse).
#include "cli/trajectory_start.h"

#include "chasles/base/invalid_input.h"
#include "chasles/base/number_text.h"
#include "chasles/io/text_scan.h"
#include "cli/message_values.h"
#include "cli/options.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

namespace chasles::cli {
namespace {

using Json = nlohmann::json;

constexpr int deepest_message = 8; ///< levels of messages around a state
constexpr auto keys_of_start = std::to_array<std::string_view>({"trajectory_start", "start_state", "sequence_start"});
constexpr double same_place = 1e-6; ///< files have rounded numbers

using Start = std::pair<std::string, const Json*>;

bool names_a_joint(const Json& state) {
    const auto has = [&](const char* part, const char* key) {
        const Json* joints = find_in(state, part);
        const Json* names = joints ? find_in(*joints, key) : nullptr;
        return names && !names->empty();
    };
    return has("joint_state", "name") || has("multi_dof_joint_state", "joint_names");
}

/// Adds the states below a node. Planners leave some empty.
void find_starts(const Json& json, int depth, std::vector<Start>& found) {
    if (!json.is_structured() || depth >= deepest_message)
        return;
    for (const auto& [key, value] : json.items()) {
        if (std::ranges::find(keys_of_start, key) == keys_of_start.end())
            find_starts(value, depth + 1, found);
        else if (names_a_joint(value))
            found.emplace_back(key, &value);
    }
}

double number_at(const Json& json, const char* part, const char* axis, double otherwise) {
    const Json* of = find_in(json, part);
    const Json* value = of ? find_in(*of, axis) : nullptr;
    return value ? at_place(part, [&] { return finite_in(*value); }) : otherwise;
}

Pose pose_of_transform(const Json& transform) {
    const auto at = [&](const char* axis) { return number_at(transform, "translation", axis, 0); };
    const auto turn = [&](const char* axis, double otherwise) {
        return number_at(transform, "rotation", axis, otherwise);
    };
    return {{at("x"), at("y"), at("z")}, Eigen::Quaterniond(turn("w", 1), turn("x", 0), turn("y", 0), turn("z", 0))};
}

bool is_same_pose(const Pose& first, const Pose& second) {
    return (first.isometry().matrix() - second.isometry().matrix()).cwiseAbs().maxCoeff() <= same_place;
}

/// A joint of the robot may stay where it is without the state. Another one is that of an SRDF file, between the world
/// and the root link.
void require_no_move(const std::string& joint, const Pose& pose, const Robot& robot) {
    const auto& joints = robot.description().joints;
    const bool is_of_robot = std::ranges::find(joints, joint, &JointDescription::name) != joints.end();
    if (is_of_robot && !is_same_pose(pose, Pose()))
        throw InvalidInput("the pose of " + io::in_quotes(joint) + " is not read; a table of columns can hold it");
    if (!is_of_robot && !is_same_pose(pose, robot.base()))
        throw InvalidInput("the base of the robot is not where " + io::in_quotes(joint) +
                           " puts it; give this pose by --base, or take it out of the file");
}

void require_no_moves(const Json& state, const Robot& robot) {
    const Json* names = find_in(state, "joint_names");
    const Json* transforms = find_in(state, "transforms");
    if (!names || !transforms)
        return;
    const std::vector<std::string> joints = names_in(*names);
    if (entries_of(*transforms).size() != joints.size())
        throw InvalidInput("transforms: " + std::to_string(transforms->size()) + " found, and joint_names has " +
                           std::to_string(joints.size()));
    for (std::size_t i = 0; i < joints.size(); ++i)
        require_no_move(joints[i], pose_of_transform((*transforms)[i]), robot);
}

void read_joints(const Json& state, TrajectoryStart& start) {
    const Json* names = find_in(state, "name");
    const Json* values = find_in(state, "position");
    if (!names || names->empty())
        return;
    start.joints = at_place("name", [&] { return names_in(*names); });
    if (!values || entries_of(*values).size() != start.joints.size())
        throw InvalidInput("position: " + std::to_string(values ? values->size() : 0) + " found, and name has " +
                           std::to_string(start.joints.size()));
    for (const Json& value : *values)
        start.values.push_back(at_place("position: " + io::in_quotes(start.joints[start.values.size()]),
                                        [&] { return finite_in(value); }));
}

/// The place of a joint among names.
std::optional<std::size_t> place_among(const std::vector<std::string>& names, const std::string& joint) {
    const auto found = std::ranges::find(names, joint);
    return found == names.end() ? std::nullopt : std::optional<std::size_t>(found - names.begin());
}

} // namespace

TrajectoryStart TrajectoryStart::without(const std::vector<std::string>& names) const {
    TrajectoryStart rest{.key = key};
    for (std::size_t i = 0; i < joints.size(); ++i)
        if (!place_among(names, joints[i])) {
            rest.joints.push_back(joints[i]);
            rest.values.push_back(values[i]);
        }
    return rest;
}

std::vector<std::string> TrajectoryStart::warnings_about(const std::vector<std::string>& names,
                                                         std::span<const double> first) const {
    std::vector<std::string> lines = warnings;
    for (std::size_t i = 0; i < joints.size(); ++i)
        if (const auto place = place_among(names, joints[i]); place && std::abs(first[*place] - values[i]) > same_place)
            lines.push_back(key + ": " + io::in_quotes(joints[i]) + " is " + number_text(values[i]) +
                            ", and the first point has " + number_text(first[*place]) +
                            ": the way between them is not tested");
    return lines;
}

TrajectoryStart trajectory_start_in(const Json& json, const Robot& robot) {
    std::vector<Start> found;
    find_starts(json, 0, found);
    TrajectoryStart start;
    if (found.empty())
        return start;
    if (std::ranges::any_of(found, [&](const Start& other) { return *other.second != *found.front().second; }))
        throw InvalidInput("has " + std::to_string(found.size()) + " states where a trajectory may start (" +
                           found[0].first + ", " + found[1].first + "): leave one in the file");
    start.key = found.front().first;
    const Json& state = *found.front().second;
    at_place(start.key, [&] {
        if (const Json* joints = find_in(state, "joint_state"))
            at_place("joint_state", [&] { read_joints(*joints, start); });
        if (const Json* joints = find_in(state, "multi_dof_joint_state"))
            at_place("multi_dof_joint_state", [&] { require_no_moves(*joints, robot); });
    });
    if (const Json* parts = find_in(state, "attached_collision_objects"); parts && !parts->empty())
        start.warnings.push_back(start.key + ": attached_collision_objects: are not read; --attach adds a part");
    return start;
}

} // namespace chasles::cli
