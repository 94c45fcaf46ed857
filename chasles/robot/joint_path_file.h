// Reads paths of robots from CSV files. The format is in docs/command-line.md.
#pragma once

#include "chasles/robot/robot.h"

#include <filesystem>
#include <string_view>
#include <vector>

namespace chasles::robot {

/// Configurations of a robot, at least two.
struct ConfigurationRows {
    std::vector<Configuration> configurations;
    std::vector<double> stamps; ///< the column "t", ascending; empty without this column
};

/// Reads one configuration a row. The header names variables of the robot, in any order, and has an optional first
/// column "t". Variables that are left out have the values of Robot::neutral(). Throws InvalidInput "FILE: line N:
/// WHY".
ConfigurationRows load_configurations(const std::filesystem::path& file, const Robot& robot);

/// Likewise for the content of a file. Its messages do not contain the file name.
ConfigurationRows read_configurations(std::string_view text, const Robot& robot);

} // namespace chasles::robot
