// Finds the files that a robot's file refers to.
#pragma once

#include "chasles/robot/robot.h"

#include <filesystem>
#include <string>

namespace chasles::robot {

/// The file that a URI of a URDF file means: package://NAME/REST, file://PATH, or a path, which is relative to the URDF
/// file. Throws InvalidInput with all places where the file was looked for.
std::filesystem::path resolved(const std::string& uri, const std::filesystem::path& urdf, const RobotFiles& files);

} // namespace chasles::robot
