// A small robot for tests of single pairs.
#pragma once

#include "chasles/robot/robot.h"

namespace chasles::test {

/// A shape on an arm that turns about z, at a distance from the axis; the base has shapes, and the arm itself none.
inline Robot turning_arm(const Polyhedron& shape, double distance, const std::vector<CollisionDescription>& base = {}) {
    RobotDescription robot{"turning"};
    Pose place;
    place.translation.x() = distance;
    robot.links = {{"base", base}, {"between"}, {"arm", {{shape, place}}}};
    JointDescription fixed{"fixed", JointType::fixed, "base", "between"};
    JointDescription turn{"turn", JointType::revolute, "between", "arm"};
    turn.axis = Eigen::Vector3d::UnitZ();
    turn.lower = -3;
    turn.upper = 3;
    robot.joints = {fixed, turn};
    return Robot(robot);
}

} // namespace chasles::test
