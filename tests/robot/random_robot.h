// Robots made by chance.
#pragma once

#include "chasles/robot/robot.h"
#include "tests/query/bodies.h"
#include "tests/support/plain_kinematics.h"
#include "tests/support/random_poses.h"

#include <algorithm>

namespace chasles::test {

/// A tree of links with joints of all types; each link has an octahedron. Joints follow others now and then.
inline RobotDescription random_robot(Random& random, int links, bool has_floating) {
    RobotDescription robot{"random"};
    std::mt19937 shapes(unsigned(random.integer(0, 1 << 30)));
    for (int i = 0; i < links; ++i) {
        LinkDescription link{"link " + std::to_string(i)};
        const int count = random.chance(0.15) ? 0 : random.chance(0.2) ? 2 : 1;
        for (int k = 0; k < count; ++k)
            link.collisions.push_back({random_octahedron(shapes).polyhedron(), random_pose(random, 0.5)});
        robot.links.push_back(link);
        if (i == 0)
            continue;
        JointDescription joint{"joint " + std::to_string(i)};
        const int last = has_floating ? 6 : 5;
        constexpr std::array types{JointType::revolute,  JointType::revolute, JointType::continuous,
                                   JointType::prismatic, JointType::planar,   JointType::fixed,
                                   JointType::floating};
        joint.type = types[std::size_t(random.integer(0, last))];
        joint.parent = robot.links[std::size_t(random.integer(std::max(0, i - 2), i - 1))].name;
        joint.child = link.name;
        joint.origin = random_pose(random, 2);
        joint.axis = random.chance(0.5) ? Eigen::Vector3d(Eigen::Vector3d::UnitZ()) : random_point(random, 3);
        if (joint.type == JointType::revolute || joint.type == JointType::prismatic) {
            joint.lower = random.uniform(-2, 0);
            joint.upper = random.uniform(0, 2);
        }
        robot.joints.push_back(joint);
    }
    for (JointDescription& joint : robot.joints) { // the one that is followed may come later
        const auto has_one = [](const JointDescription& j) {
            return j.type == JointType::revolute || j.type == JointType::prismatic || j.type == JointType::continuous;
        };
        const JointDescription& other = robot.joints[std::size_t(random.integer(0, int(robot.joints.size()) - 1))];
        if (has_one(joint) && has_one(other) && !other.mimic && &other > &joint && random.chance(0.3))
            joint.mimic = MimicDescription{other.name, random.uniform(-2, 2), random.uniform(-1, 1)};
    }
    std::mt19937 order(unsigned(random.integer(0, 1 << 30)));
    std::ranges::shuffle(robot.joints, order);
    return robot;
}

inline Configuration random_configuration(Random& random, const Robot& robot, double size = 2) {
    Configuration values(Eigen::Index(robot.variables().size()));
    for (Eigen::Index i = 0; i < values.size(); ++i)
        values[i] = random.uniform(-size, size);
    return values;
}

} // namespace chasles::test
