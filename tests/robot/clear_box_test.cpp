// Clear boxes around configurations: no sample in them touches, and no side can be moved far.
#include "tests/robot/arm_beside_a_wall.h"

#include <gtest/gtest.h>

namespace chasles::test {
namespace {

TEST(ClearBox, IsProvenAndNoSideCanBeMovedFar) {
    Random random(4003);
    const Robot robot = arm_beside_a_wall();
    const Scene scene = wall_at(1.2);
    const RobotChecker checker(robot, &scene);
    const ConfigurationBox within = box_of_joints(robot, both, robot.neutral());
    int moved = 0;
    for (int round = 0; round < 20; ++round) {
        const Configuration around = sample(random, within);
        const ClearBox found = checker.clear_box(within, around);
        ASSERT_TRUE(found.box.contains(around));
        if (tip_of(around) + tip_radius >= 1.2) {
            EXPECT_EQ(found.verdict, RangeVerdict::contact);
            EXPECT_EQ(found.share, 0);
            continue;
        }
        EXPECT_EQ(found.verdict, RangeVerdict::clear);
        EXPECT_TRUE(found.is_maximal);
        for (int i = 0; i < 300; ++i)
            EXPECT_LT(tip_of(sample(random, found.box)) + tip_radius, 1.2);
        for (const Eigen::Index i : {0, 1})
            for (const bool is_upper : {false, true}) {
                ConfigurationBox wider = found.box;
                double& end = is_upper ? wider.upper[i] : wider.lower[i];
                end += (is_upper ? 0.03 : -0.03) * (within.upper[i] - within.lower[i]);
                if (end > within.upper[i] || end < within.lower[i])
                    continue;
                double farthest = -9;
                for (int k = 0; k < 4000; ++k)
                    farthest = std::max(farthest, tip_of(sample(random, wider)));
                EXPECT_GT(farthest + tip_radius, 1.19) << "the wall, or nearly, is beyond each side";
                ++moved;
            }
    }
    EXPECT_GT(moved, 10);
}

/// A cube that slides towards its like, clear exactly below 0.25.
TEST(ClearBox, NoSideCanBeMovedByTheTolerance) {
    RobotDescription description{"slide"};
    description.links = {{"base"}, {"cube", {{make_box({1, 1, 1})}}}};
    JointDescription slide{"x", JointType::prismatic, "base", "cube"};
    slide.lower = 0;
    slide.upper = 1;
    description.joints = {slide};
    const Robot robot(description);
    Scene scene;
    scene.add({"wall", make_box({1, 1, 1}), Motion::at_rest(shifted(1.25, 0, 0))});
    const RobotChecker checker(robot, &scene);
    const Configuration home = robot.neutral();
    const ConfigurationBox within = box_of_joints(robot, std::vector<std::string>{"x"}, home);
    for (const double tolerance : {0.05, 0.01, 0.003}) {
        RangeOptions options;
        options.tolerance = tolerance;
        const ClearBox found = checker.clear_box(within, home, options);
        EXPECT_TRUE(found.is_maximal);
        EXPECT_LT(found.box.upper[0], 0.25);
        EXPECT_GT(found.box.upper[0] + tolerance, 0.25) << tolerance;
    }
}

TEST(ClearBox, IsTheWholeBoxWhereNothingIsNear) {
    const Robot robot = arm_beside_a_wall();
    const ConfigurationBox within = box_of_joints(robot, both, robot.neutral());
    const ClearBox found = RobotChecker(robot).clear_box(within, values(0.3, 0.1));
    EXPECT_EQ(found.verdict, RangeVerdict::clear);
    EXPECT_EQ(found.box.lower, within.lower);
    EXPECT_EQ(found.box.upper, within.upper);
    EXPECT_EQ(found.share, 1);
    EXPECT_TRUE(found.is_maximal);
}

} // namespace
} // namespace chasles::test
