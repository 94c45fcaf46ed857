// Robots that start within a margin and move on, against closed forms and against the same motion in one scene.
#include "chasles/mesh/primitives.h"
#include "tests/robot/all_pairs.h"
#include "tests/support/refusal.h"

#include <gtest/gtest.h>

namespace chasles::test {
namespace {

/// A cube of side 1 that slides along z and then along x, with a speck between, above a table whose top is z = 0.
Robot crane() {
    RobotDescription robot{"crane"};
    robot.links = {{"base"}, {"lift"}, {"load", {{make_box({1, 1, 1}), shifted(0, 0, 0.5)}}}};
    robot.joints = {{"z", JointType::prismatic, "base", "lift"}, {"x", JointType::prismatic, "lift", "load"}};
    robot.joints[0].axis = Eigen::Vector3d::UnitZ();
    for (JointDescription& joint : robot.joints) {
        joint.lower = -10;
        joint.upper = 10;
    }
    return Robot(robot);
}

Scene table() {
    Scene scene;
    scene.add({"table", make_box({20, 20, 1}), Motion::at_rest(shifted(0, 0, -0.5))});
    return scene;
}

Configuration crane_at(double z, double x) {
    Configuration q(2);
    q << z, x;
    return q;
}

const RobotQuery holds{{.margin = 0.1, .hold = 0.02}};

TEST(RobotHold, WhatStartsWithinTheMarginMayMoveOn) {
    const Robot robot = crane();
    const Scene scene = table();
    const RobotChecker checker(robot, &scene, holds);
    const RobotAnswer along = checker.first_contact(crane_at(0.05, 0), crane_at(0.05, 3));
    EXPECT_EQ(along.verdict, Verdict::clear);
    EXPECT_EQ(along.clear_until, 1);
    EXPECT_TRUE(checker.is_clear(crane_at(0.05, 0), crane_at(0.05, 3)));
    EXPECT_EQ(
        RobotChecker(robot, &scene, {{.margin = 0.1}}).first_contact(crane_at(0.05, 0), crane_at(0.05, 3)).verdict,
        Verdict::contact_at_start)
        << "without hold";
    // From 0.05 down to 0: the hold distance, with a reserve of some 1e-13, is reached at 0.6 of the way.
    const RobotAnswer down = checker.first_contact(crane_at(0.05, 0), crane_at(0, 3));
    EXPECT_EQ(down.verdict, Verdict::contact);
    EXPECT_NEAR(down.time.lower, 0.6, 1e-9);
    EXPECT_NEAR(down.clear_until, 0.6, 1e-9);
    EXPECT_LE(down.clear_until, down.time.upper);
    EXPECT_FALSE(down.contact.held.empty());
    EXPECT_FALSE(checker.is_clear(crane_at(0.05, 0), crane_at(0, 3)));
    // From farther away the margin counts.
    EXPECT_NEAR(checker.first_contact(crane_at(0.2, 0), crane_at(0, 3)).time.lower, 0.5, 1e-9);
    EXPECT_EQ(checker.first_contact(crane_at(0.01, 0), crane_at(0.01, 3)).verdict, Verdict::clear)
        << "as near as at the start";
    EXPECT_LT(checker.first_contact(crane_at(0.01, 0), crane_at(0.005, 3)).clear_until, 1e-6) << "nearer";
    EXPECT_EQ(checker.first_contact(crane_at(-0.1, 0), crane_at(1, 0)).verdict, Verdict::contact_at_start) << "overlap";
}

TEST(RobotHold, EachSegmentBeginsAnew) {
    const Robot robot = crane();
    const Scene scene = table();
    const RobotChecker checker(robot, &scene, holds);
    const std::array way{crane_at(0.05, 0), crane_at(0.03, 1), crane_at(0.03, 2), crane_at(0.01, 3)};
    const RobotAnswer found = checker.first_contact(JointPath::straight(robot, way));
    EXPECT_EQ(found.verdict, Verdict::contact);
    EXPECT_EQ(found.segment, 2U);
    EXPECT_NEAR(found.time.lower, 2.5, 1e-9);
}

/// The load leaves the margin and comes back within one segment: it is held all along, so only `hold` counts.
TEST(RobotHold, APairThatIsHeldIsHeldForTheWholeSegment) {
    const Robot robot = crane();
    const Scene scene = table();
    std::vector<JointPath::Segment> segments(1);
    segments[0].coefficients = Eigen::MatrixXd::Zero(3, 2);
    const auto bounce = [&](double end) { // z = 0.05 + 8 t - (8.05 - end) t^2
        segments[0].coefficients.col(0) << 0.05, 8, -(8.05 - end);
        return RobotChecker(robot, &scene, holds).first_contact(JointPath::polynomials(robot, segments));
    };
    EXPECT_EQ(bounce(0.05).verdict, Verdict::clear);
    const RobotAnswer found = bounce(0);
    EXPECT_EQ(found.verdict, Verdict::contact);
    EXPECT_GT(found.time.lower, 0.99);
    const double z = 0.05 + 8 * found.time.lower - 8.05 * found.time.lower * found.time.lower;
    EXPECT_NEAR(z, 0.02, 1e-9);
}

/// Arms that turn, each pair by itself along the same motions with the same options.
TEST(RobotHold, AnswersAsAllPairsByThemselves) {
    Random random(4102);
    int held = 0, contacts = 0;
    for (int round = 0; round < 300; ++round) {
        const Robot robot(random_robot(random, 6, round % 3 == 0));
        const Scene scene = random_world(random, 3);
        const std::array<Configuration, 2> ends{random_configuration(random, robot),
                                                random_configuration(random, robot)};
        bool has_quaternion = false;
        for (const RobotVariable& variable : robot.variables())
            has_quaternion = has_quaternion || variable.name.ends_with("rot_w");
        const QueryOptions options{.margin = 1, .hold = 0.05};
        double first = 2, least_clear = 1;
        bool at_start = false;
        if (!has_quaternion)
            for_each_pair(robot, scene, ends, [&](const Polyhedron& a, const Polyhedron& b, const Motion& motion) {
                const FirstContact found = chasles::first_contact({a, b, motion, options});
                held += int(!found.held.empty());
                least_clear = std::min(least_clear, found.clear_until);
                if (found.verdict != Verdict::clear)
                    first = std::min(first, found.time.lower);
                at_start = at_start || found.verdict == Verdict::contact_at_start;
            });
        if (has_quaternion)
            continue;
        const RobotAnswer found = RobotChecker(robot, &scene, {options}).first_contact(ends[0], ends[1]);
        EXPECT_EQ(found.verdict == Verdict::clear, first == 2) << round;
        EXPECT_EQ(found.verdict == Verdict::contact_at_start, at_start) << round;
        EXPECT_LE(found.clear_until, least_clear + 1e-9) << round;
        if (found.verdict != Verdict::clear) {
            EXPECT_NEAR(found.time.lower, first, 1e-9) << round;
            ++contacts;
        }
    }
    EXPECT_GT(held, 100);
    EXPECT_GT(contacts, 50);
}

TEST(RobotHold, NeedsSomeGreaterMargin) {
    Robot robot = crane();
    EXPECT_EQ(refusal([&] { (void)RobotChecker(robot, nullptr, {{.margin = 0.1, .hold = 0.1}}); }),
              "query: hold: 0.1 is not less than the margin 0.1");
    EXPECT_EQ(refusal([&] { (void)RobotChecker(robot, nullptr, {{.hold = 0.1}}); }),
              "query: hold: 0.1 is not less than the margin, which is 0 unless one is given");
    EXPECT_EQ(refusal([&] { (void)RobotChecker(robot, nullptr, {{.margin = 0.1, .hold = -1}}); }),
              "query: hold: must be in [0, 1e30]");
    robot.set_margin("base", "load", 0.3);
    EXPECT_EQ(refusal([&] { (void)RobotChecker(robot, nullptr, {{.margin = -1, .hold = 0.1}}); }),
              "query: margin: must be in [0, 1e30]")
        << "the margin of a pair hides no wrong one";
    EXPECT_EQ(refusal([&] { (void)RobotChecker(robot, nullptr, {{.margin = 0.1, .hold = 0.5}}); }),
              "query: hold: 0.5 is not less than the margin 0.3");
    EXPECT_EQ(refusal([&] { (void)RobotChecker(robot, nullptr, {{.margin = 0.1, .hold = 0.1}}); }), "accepted");
}

} // namespace
} // namespace chasles::test
