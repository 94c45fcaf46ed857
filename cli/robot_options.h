// The robot of `robot`, `range`, `acm` and `info`, or several robots: their files, and where packages are.
#pragma once

#include "chasles/chasles.h"

#include <CLI/CLI.hpp>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace chasles::cli {

struct RobotOptions {
    std::string urdf;
    std::string srdf;
    std::vector<std::string> packages; ///< NAME=FOLDER
    Solid solid = Solid::automatic;
    std::pair<double, double> radii; ///< of the robot's shapes, and of the scene's bodies
    /// One file, or NAME=FILE for each robot of a cell. Then each value of an option is NAME=VALUE.
    std::vector<std::string> robots = {};
    std::vector<std::string> srdfs = {};
    std::vector<std::string> bases = {};
};

using NamedRobots = std::vector<std::pair<std::string, Robot>>;

/// The options about further files of one robot, and that robot.
void add_robot_file_options(CLI::App& command, RobotOptions& options);
Robot load_robot(const RobotOptions& options);

/// The files of one robot or of several, and the options about further files and bases.
void add_cell_options(CLI::App& command, RobotOptions& options);
/// All of them by name; a single one that is no cell has the name "".
NamedRobots load_robots(const RobotOptions& options);
bool is_cell(const NamedRobots& robots);
/// The single one, or the cell.
Robot together(const NamedRobots& robots);

/// The values of an option by robot: of NAME=VALUE, or the whole text for a robot without a name. Throws InvalidInput
/// "OPTION: WHY" for a name that no robot has, and for two values of one robot.
std::map<std::string, std::string> values_by_robot(const char* option, const std::vector<std::string>& given,
                                                   const std::vector<std::string>& names);

} // namespace chasles::cli
