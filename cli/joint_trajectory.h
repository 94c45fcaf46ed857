// Trajectories of ROS (trajectory_msgs/JointTrajectory) and recordings of states (sensor_msgs/JointState) as YAML or
// JSON.
#pragma once

#include "chasles/robot/joint_path_file.h"

#include <filesystem>
#include <string>

namespace chasles::cli {

/// Whether a file is such a trajectory and no table, by its name and by its first line.
bool is_joint_trajectory(const std::filesystem::path& file, const std::string& text);

/// Reads joint_names, and positions and time_from_start of each point, wherever they are in the text: `ros2 topic echo`
/// and messages that hold a trajectory are read too. A text without a trajectory may have states, with name and
/// position. Numbers that are not read may be NaN or infinite. Throws InvalidInput for a text without a trajectory and
/// with more than one.
robot::ConfigurationRows read_joint_trajectory(const std::string& text, bool is_json, const Robot& robot);

/// Reads the path of a robot from a file of any format, of at least so many configurations. Throws InvalidInput
/// "FILE: WHY". Warnings have the same form.
robot::ConfigurationRows load_joint_path(const std::filesystem::path& file, const Robot& robot, std::size_t least = 2);

} // namespace chasles::cli
