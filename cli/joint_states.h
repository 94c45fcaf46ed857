// Recordings of the states of joints (sensor_msgs/JointState of ROS), as YAML or JSON.
#pragma once

#include <nlohmann/json.hpp>

#include <optional>

namespace chasles::cli {

/// The messages with `name` and `position` in a text, as a trajectory with joint_names and points: each message is a
/// point at the time of its stamp, with the names of keys that are not read. None if there is no such message. Throws
/// InvalidInput for messages with different names.
std::optional<nlohmann::json> trajectory_of_states(const nlohmann::json& json);

} // namespace chasles::cli
