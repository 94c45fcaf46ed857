// Reads robots from URDF and SRDF files. `Robot::load` (chasles/robot/robot.h) is defined in urdf_reader.cpp.
#pragma once

#include "chasles/robot/robot.h"

#include <filesystem>

namespace chasles::io {

/// The links, joints and collision shapes of a URDF file of version 1.0 to 1.2. Whatever else it has is ignored: visual
/// shapes, masses, transmissions. Throws InvalidInput "FILE:LINE: <ELEMENT NAME>: WHY".
RobotDescription read_urdf(const std::filesystem::path& file, const RobotFiles& files);

/// Adds the pairs, groups and states of an SRDF file. Files are often shared by variants of a robot. Therefore links
/// and joints that the robot does not have are left out, also of pairs, which loses no contact. Pairs that are to be
/// tested must exist. Throws InvalidInput "FILE:LINE: <ELEMENT NAME>: WHY".
void read_srdf(const std::filesystem::path& file, RobotDescription& robot);

} // namespace chasles::io
