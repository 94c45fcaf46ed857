// The state of a robot where a trajectory of MoveIt starts: it holds the joints that the trajectory does not move.
#pragma once

#include "chasles/robot/robot.h"

#include <nlohmann/json.hpp>

#include <span>
#include <string>
#include <vector>

namespace chasles::cli {

/// What a moveit_msgs/RobotState says about the joints.
struct TrajectoryStart {
    std::string key = {};                 ///< of the state in its message; empty without a state
    std::vector<std::string> joints = {}; ///< names, as many as values
    std::vector<double> values = {};
    std::vector<std::string> warnings = {}; ///< what the state has and the path has not

    /// The joints that do not have these names.
    [[nodiscard]] TrajectoryStart without(const std::vector<std::string>& names) const;
    /// The warnings, and joints that the first point of a trajectory with these names has elsewhere.
    [[nodiscard]] std::vector<std::string> warnings_about(const std::vector<std::string>& names,
                                                          std::span<const double> first) const;
};

/// The state `trajectory_start`, `start_state` (answers about Cartesian paths) or `sequence_start` in a message, at
/// most one. Throws InvalidInput for several, and for a multi_dof_joint_state that moves a joint of the robot or puts
/// its root link elsewhere than its base is.
TrajectoryStart trajectory_start_in(const nlohmann::json& json, const Robot& robot);

} // namespace chasles::cli
