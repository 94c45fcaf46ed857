// A robot that is made again of its description and its changes answers as the robot does.
#include "chasles/robot/robot.h"

#include "tests/robot/random_robot.h"
#include "tests/support/refusal.h"

#include <gtest/gtest.h>

namespace chasles::test {
namespace {

/// Two links that may touch, a part, and one of each change.
Robot changed_robot(Random& random) {
    RobotDescription description = random_robot(random, 6, true);
    Robot robot(description);
    robot.set_base(random_pose(random, 3));
    const std::string first = description.links[1].name, last = description.links.back().name;
    robot.attach({"part", last, box({0.1, 0.2, 0.3}).polyhedron(), random_pose(random, 1), {first}});
    robot.ignore("part", description.links[0].name);
    for (const LinkDescription& link : description.links)
        if (link.name != first)
            robot.test(first, link.name); // also those that are not tested at first
    robot.ignore_in_scene("part", "wall");
    robot.set_margin("part", description.links[0].name, 0.25);
    return robot;
}

TEST(RobotChanges, MakeTheRobotAgain) {
    Random random(2101);
    int tested = 0, ignored = 0;
    for (int trial = 0; trial < 20; ++trial) {
        const Robot robot = changed_robot(random);
        const Robot again(robot.description(), robot.changes());
        EXPECT_EQ(again.base().isometry().matrix(), robot.base().isometry().matrix());
        EXPECT_EQ(again.attached().size(), 1U);
        EXPECT_FALSE(again.is_tested_in_scene("part", "wall"));
        for (const LinkDescription& a : robot.description().links)
            for (const std::string b : {"part", robot.description().links[1].name.c_str()})
                if (a.name != b) {
                    EXPECT_EQ(again.is_tested(a.name, b), robot.is_tested(a.name, b)) << a.name << ", " << b;
                    ++(robot.is_tested(a.name, b) ? tested : ignored);
                }
        EXPECT_EQ(again.changes().margins, robot.changes().margins);
        const Configuration from = random_configuration(random, robot), to = random_configuration(random, robot);
        const RobotAnswer expected = RobotChecker(robot).first_contact(from, to);
        const RobotAnswer found = RobotChecker(again).first_contact(from, to);
        EXPECT_EQ(found.verdict, expected.verdict);
        EXPECT_EQ(found.time.lower, expected.time.lower);
    }
    EXPECT_GT(tested, 20);
    EXPECT_GT(ignored, 20);
}

TEST(RobotChanges, RefuseUnknownNames) {
    const Robot robot(RobotDescription{"one", {{"base"}}});
    RobotChanges changes;
    changes.ignored = {{"base", "tip"}};
    EXPECT_EQ(refusal([&] { (void)Robot(robot.description(), changes); }), "robot: tip: there is no such link or part");
}

} // namespace
} // namespace chasles::test
