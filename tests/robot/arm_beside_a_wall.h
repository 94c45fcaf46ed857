// An arm of two links in a plane, whose tip alone has a shape, beside a wall.
#pragma once

#include "chasles/mesh/primitives.h"
#include "chasles/robot/model.h"
#include "chasles/robot/range.h"
#include "tests/robot/random_robot.h"

#include <cmath>
#include <string>
#include <vector>

namespace chasles::test {

inline constexpr double upper_arm = 1, forearm = 0.8, tip_radius = 0.1;

/// Two links in a plane. Only the tip has a shape, a ball.
inline Robot arm_beside_a_wall() {
    RobotDescription robot{"planar"};
    robot.links = {{"base"}, {"upper"}, {"fore", {{make_sphere(tip_radius), shifted(forearm, 0, 0)}}}};
    const auto turn = [](const char* name, const char* parent, const char* child, double at) {
        JointDescription joint{name, JointType::revolute, parent, child};
        joint.axis = Eigen::Vector3d::UnitZ();
        joint.origin = shifted(at, 0, 0);
        joint.lower = -3;
        joint.upper = 3;
        return joint;
    };
    robot.joints = {turn("shoulder", "base", "upper", 0), turn("elbow", "upper", "fore", upper_arm)};
    return Robot(robot);
}

/// A wall that begins at this x.
inline Scene wall_at(double x) {
    Scene scene;
    scene.add({"wall", make_box({1, 9, 9}), Motion::at_rest(shifted(x + 0.5, 0, 0))});
    return scene;
}

inline double tip_of(const Configuration& q) {
    return upper_arm * std::cos(q[0]) + forearm * std::cos(q[0] + q[1]);
}

inline Configuration values(double first, double second) {
    Configuration q(2);
    q << first, second;
    return q;
}

inline Configuration sample(Random& random, const ConfigurationBox& box) {
    Configuration q = box.lower;
    for (Eigen::Index i = 0; i < q.size(); ++i)
        if (box.lower[i] < box.upper[i])
            q[i] = random.chance(0.1)   ? box.lower[i]
                   : random.chance(0.1) ? box.upper[i]
                                        : random.uniform(box.lower[i], box.upper[i]);
    return q;
}

inline const std::vector<std::string> both{"shoulder", "elbow"};

} // namespace chasles::test
