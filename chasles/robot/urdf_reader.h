// Reads robots from URDF and SRDF files. `Robot::load` (chasles/robot/robot.h) is defined in srdf_reader.cpp.
#pragma once

#include "chasles/robot/robot.h"

#include <filesystem>

namespace chasles::robot {

/// The links, joints and collision shapes of a URDF file of version 1.0 to 1.2. Whatever else it has is ignored: visual
/// shapes, masses, transmissions. Shapes without extent become 1e-6 length units thick. A joint that has to follow a
/// joint of an unknown name has a variable of its own, as in MoveIt and Pinocchio: real files misname joints there. A
/// lower limit above the upper one means no limits. Both make a warning.
/// Throws InvalidInput "FILE:LINE: <ELEMENT NAME>: WHY".
RobotDescription read_urdf(const std::filesystem::path& file, const RobotFiles& files);

/// Adds the pairs, groups and states of an SRDF file to a tree. Files are often shared by variants of a robot.
/// Therefore links, joints and groups that do not exist are left out, also of pairs, which loses no contact. Each name
/// that is left out makes a warning. Pairs that
/// are to be tested must exist; a pair that is also disabled is not tested, as in MoveIt. A group has the links that it
/// names, and the child links of its joints. Throws InvalidInput "FILE:LINE: <ELEMENT NAME>: WHY".
void read_srdf(const std::filesystem::path& file, RobotDescription& robot);

} // namespace chasles::robot
