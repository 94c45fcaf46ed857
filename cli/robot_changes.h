// What the command line changes of a robot before the question: parts that it carries, and pairs that are not tested.
#pragma once

#include "chasles/chasles.h"

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace chasles::cli {

struct RobotChangeOptions {
    std::vector<std::string> allow;  ///< LINK,BODY
    std::vector<std::string> attach; ///< LINK,MESH,POSE
};

void add_robot_change_options(CLI::App& command, RobotChangeOptions& options);

/// Attaches parts, then leaves out pairs. `scene` may be null. Throws InvalidInput "--allow: ..." or "--attach: ...".
/// Adds what is to be told of the parts.
void change(Robot& robot, const Scene* scene, const RobotChangeOptions& options, const PolyhedronOptions& polyhedron,
            std::vector<std::string>& warnings);

} // namespace chasles::cli
