// The robot of `robot`, `acm` and `info`: its files, and where packages are.
#pragma once

#include "chasles/chasles.h"

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace chasles::cli {

struct RobotOptions {
    std::string urdf;
    std::string srdf;
    std::vector<std::string> packages; ///< NAME=FOLDER
    Solid solid = Solid::automatic;
    std::pair<double, double> radii; ///< of the robot's shapes, and of the scene's bodies
};

/// The file of the robot, and the options about further files; and these options alone.
void add_robot_options(CLI::App& command, RobotOptions& options);
void add_robot_file_options(CLI::App& command, RobotOptions& options);
Robot load_robot(const RobotOptions& options);

} // namespace chasles::cli
