// Checks of what a description says about its parts one by one; `Model` checks that they are a tree.
#pragma once

#include "chasles/robot/robot_description.h"

namespace chasles::robot {

/// Axes, limits, and what a joint follows. Throws InvalidInput "robot: JOINT: WHY".
void check(const JointDescription& joint);
/// Shapes, and the names and values of groups and states. Throws InvalidInput.
void check_parts(const RobotDescription& robot);

} // namespace chasles::robot
