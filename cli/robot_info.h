// What `chasles info` says about a robot: joints, limits, links, shapes, and which pairs are tested.
#pragma once

#include "cli/robot_options.h"

namespace chasles::cli {

/// Whether the file is a robot, by the end of its name.
bool is_robot_file(const std::string& file);

int run_robot_info(const RobotOptions& options, bool json);

} // namespace chasles::cli
