// What random paths are made of.
#pragma once

#include "tests/robot/random_robot.h"

#include <vector>

namespace chasles::test {

/// One revolute, one continuous and one prismatic joint.
inline Robot three_joint_robot() {
    RobotDescription robot{"small"};
    robot.links = {{"base"}, {"a"}, {"b"}, {"c"}};
    robot.joints = {{"turn", JointType::revolute, "base", "a"},
                    {"spin", JointType::continuous, "a", "b"},
                    {"slide", JointType::prismatic, "b", "c"}};
    return Robot(robot);
}

inline std::vector<Configuration> random_configurations(Random& random, const Robot& robot, std::size_t count,
                                                        double size) {
    std::vector<Configuration> all;
    for (std::size_t i = 0; i < count; ++i)
        all.push_back(random_configuration(random, robot, size));
    return all;
}

inline std::vector<double> random_stamps(Random& random, std::size_t count) {
    std::vector<double> stamps{random.uniform(-3, 3)};
    while (stamps.size() < count)
        stamps.push_back(stamps.back() + random.uniform(0.1, 2));
    return stamps;
}

} // namespace chasles::test
