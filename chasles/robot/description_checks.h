// Checks each part of a description by itself. `Model` checks that the parts are a tree.
#pragma once

#include "chasles/robot/robot_description.h"

namespace chasles::robot {

/// Axes, limits, and what a joint follows. Throws InvalidInput "robot: JOINT: WHY".
void check(const JointDescription& joint);
/// Shapes, and the names and values of groups and states. Throws InvalidInput.
void check_parts(const RobotDescription& robot);

} // namespace chasles::robot
