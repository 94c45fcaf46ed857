// What is proven to overlap nearby does so, by questions about single configurations.
#include "chasles/robot/overlap_proof.h"

#include "chasles/mesh/primitives.h"
#include "tests/robot/random_robot.h"

#include <gtest/gtest.h>

namespace chasles::test {
namespace {

/// A body that slides along x, y and z against another one; specks between them are far away.
RobotDescription sliding_body(const Polyhedron& fixed, const Polyhedron& moving, const Pose& turn) {
    RobotDescription robot{"sliding"};
    robot.links = {{"fixed", {{fixed}}}, {"x"}, {"y"}, {"moving", {{moving, turn}}}};
    const auto slide = [](const char* name, const char* parent, const char* child, const Eigen::Vector3d& axis) {
        JointDescription joint{name, JointType::prismatic, parent, child};
        joint.axis = axis;
        joint.lower = -9;
        joint.upper = 9;
        return joint;
    };
    robot.joints = {slide("a", "fixed", "x", Eigen::Vector3d::UnitX()), slide("b", "x", "y", Eigen::Vector3d::UnitY()),
                    slide("c", "y", "moving", Eigen::Vector3d::UnitZ())};
    return robot;
}

std::vector<const robot::Element*> elements_of(const robot::Model& model, std::size_t owner) {
    std::vector<const robot::Element*> found;
    for (const robot::Element& element : model.elements)
        if (element.owner == owner)
            found.push_back(&element);
    return found;
}

TEST(OverlapProof, WhatIsProvenHoldsForEveryDisplacement) {
    Random random(4105);
    int proven = 0, clear = 0;
    for (int round = 0; round < 400; ++round) {
        const auto box = [&] {
            return make_box({random.uniform(0.2, 3), random.uniform(0.2, 3), random.uniform(0.2, 3)});
        };
        Robot robot(sliding_body(box(), box(), random_pose(random, 0)));
        robot.test("fixed", "moving");
        const auto first = elements_of(robot.model(), 0), second = elements_of(robot.model(), 3);
        const robot::OverlapProof overlaps(robot.model(), first, second);
        const Configuration q = random_configuration(random, robot, 1.5);
        const double margin = random.uniform(0, 0.3);
        const bool is_proven = overlaps.touch_within(margin, q);
        proven += is_proven;
        clear += RobotChecker(robot).is_clear(q);
        for (int i = 0; i < 20 && is_proven; ++i) {
            const Configuration way = random_configuration(random, robot, 1);
            EXPECT_FALSE(RobotChecker(robot).is_clear(q + margin * way / way.norm())) << round;
        }
    }
    EXPECT_GT(proven, 60);
    EXPECT_GT(clear, 60);
}

TEST(OverlapProof, ProvesNothingOfOpenSurfaces) {
    const std::vector<Eigen::Vector3d> corners{{-0.2, -0.2, 0}, {3, -0.2, 0}, {3, 3, 0}, {-0.2, 3, 0}};
    const std::vector<std::vector<std::uint32_t>> square{{0, 1, 2, 3}};
    const auto proven = [](const Polyhedron& fixed, const Polyhedron& moving, double margin) {
        const Robot robot(sliding_body(fixed, moving, Pose()));
        const auto first = elements_of(robot.model(), 0), second = elements_of(robot.model(), 3);
        return robot::OverlapProof(robot.model(), first, second).touch_within(margin, Configuration::Zero(3));
    };
    EXPECT_TRUE(proven(make_box({3, 3, 3}), make_box({1, 1, 1}), 0.99)) << "nested";
    EXPECT_FALSE(proven(make_box({3, 3, 3}), make_box({1, 1, 1}), 1.51));
    EXPECT_TRUE(proven(make_box({1, 1, 1}), make_box({4, 0.2, 0.2}), 0.39)) << "a rod sticks out on both sides";
    EXPECT_FALSE(proven(make_box({1, 1, 1}), make_box({4, 0.2, 0.2}), 0.61));
    EXPECT_TRUE(proven(make_box({1, 1, 1}), Polyhedron::from_polygons(corners, square), 0.1))
        << "an open surface in a box";
    EXPECT_FALSE(proven(Polyhedron::from_polygons(corners, square), Polyhedron::from_polygons(corners, square), 0));
}

} // namespace
} // namespace chasles::test
