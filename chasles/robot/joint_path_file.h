// Reads paths of robots from tables. The format is in docs/command-line.md.
#pragma once

#include "chasles/robot/robot.h"

#include <string>
#include <string_view>
#include <vector>

namespace chasles::robot {

/// Configurations of a robot: for a path at least two.
struct ConfigurationRows {
    std::vector<Configuration> configurations;
    std::vector<double> stamps = {};        ///< the column of time stamps, increasing; empty without this column
    std::vector<std::string> warnings = {}; ///< one line each: what the file has and the path has not
};

/// Reads a table with one configuration a row. The header names variables of the robot in any order, with the ending
/// "_deg" where the column has degrees, and perhaps the time (io::is_time_column). Variables that are left out have the
/// values of Robot::neutral(). Throws InvalidInput "line N: WHY", and for fewer rows than `least`.
ConfigurationRows read_configurations(std::string_view text, const Robot& robot, std::size_t least = 2);

} // namespace chasles::robot
