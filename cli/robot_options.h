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
    /// One file, or NAME=FILE for each of several robots. Then each value of an option is NAME=VALUE.
    std::vector<std::string> robots = {};
    std::vector<std::string> srdfs = {};
    std::vector<std::string> bases = {};
};

using NamedRobots = std::vector<std::pair<std::string, Robot>>;

/// The file of the robot, and the options about further files; and these options alone.
void add_robot_options(CLI::App& command, RobotOptions& options);
void add_robot_file_options(CLI::App& command, RobotOptions& options);
Robot load_robot(const RobotOptions& options);

/// The files of one robot or of several, and the options about further files and bases.
void add_cell_options(CLI::App& command, RobotOptions& options);
/// All of them by name; a single one has the name "".
NamedRobots load_robots(const RobotOptions& options);
/// The single one, or the cell of several.
Robot together(const NamedRobots& robots);

/// The values of an option by robot: of NAME=VALUE, or the whole text for a single robot. Throws InvalidInput
/// "OPTION: WHY" for a name that no robot has, and for two values of one robot.
std::map<std::string, std::string> values_by_robot(const char* option, const std::vector<std::string>& given,
                                                   const std::vector<std::string>& names);

} // namespace chasles::cli
