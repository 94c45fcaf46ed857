// Boxes of configurations: what is proven of them holds for samples, in closed forms, and for any number of threads.
#include "chasles/robot/range.h"

#include "chasles/base/limit.h"
#include "tests/robot/arm_beside_a_wall.h"
#include "tests/support/refusal.h"

#include <chrono>
#include <gtest/gtest.h>
#include <numbers>

namespace chasles::test {
namespace {

/// The share of a box in which the tip does not reach the wall, by a fine grid; off by less than 1e-3.
double free_share(const ConfigurationBox& box, double wall, double radius) {
    constexpr int steps = 1500;
    int free = 0;
    for (int i = 0; i < steps; ++i)
        for (int k = 0; k < steps; ++k)
            free += tip_of(values(box.lower[0] + (i + 0.5) / steps * (box.upper[0] - box.lower[0]),
                                  box.lower[1] + (k + 0.5) / steps * (box.upper[1] - box.lower[1]))) +
                        radius <
                    wall;
    return double(free) / (steps * steps);
}

TEST(RobotRange, IsRightInAClosedForm) {
    Random random(4001);
    const Robot robot = arm_beside_a_wall();
    const Scene scene = wall_at(1.2);
    const ConfigurationBox box = box_of_joints(robot, both, robot.neutral());
    const RobotRange found = RobotChecker(robot, &scene).range(box, {.tolerance = 0.01});
    EXPECT_EQ(found.verdict, RangeVerdict::contact);
    EXPECT_EQ(found.joints, (std::vector<std::size_t>{0, 1}));
    EXPECT_LE(found.open_share, 0.01);
    EXPECT_NEAR(found.clear_share + found.contact_share + found.open_share, 1, 1e-12);
    const double truth = free_share(box, 1.2, tip_radius);
    EXPECT_LT(found.clear_share, truth + 1e-3);
    EXPECT_GT(found.clear_share + found.open_share, truth - 1e-3);
    ASSERT_TRUE(found.witness);
    EXPECT_GT(tip_of(*found.witness) + tip_radius, 1.2);
    EXPECT_EQ(found.pair->second, "wall");
    for (int i = 0; i < 20000; ++i) {
        const ConfigurationBox& clear = found.clear[std::size_t(i) % found.clear.size()];
        EXPECT_LT(tip_of(sample(random, clear)) + tip_radius, 1.2);
        const ConfigurationBox& contact = found.contact[std::size_t(i) % found.contact.size()];
        EXPECT_GT(tip_of(sample(random, contact)) + tip_radius, 1.2);
    }
}

TEST(RobotRange, IsClearWhereTheWallIsOutOfReach) {
    const Robot robot = arm_beside_a_wall();
    const double reach = upper_arm + forearm + tip_radius;
    const ConfigurationBox box = box_of_joints(robot, both, robot.neutral());
    const Scene far = wall_at(reach + 1e-3), near = wall_at(reach - 1e-3);
    const RobotRange clear = RobotChecker(robot, &far).range(box);
    EXPECT_EQ(clear.verdict, RangeVerdict::clear);
    EXPECT_EQ(clear.clear_share, 1);
    EXPECT_EQ(clear.open_share, 0);
    EXPECT_FALSE(clear.witness);
    ASSERT_EQ(clear.clear.size(), 1U) << "cells that fill the box are joined";
    EXPECT_EQ(clear.clear[0].lower, box.lower);
    EXPECT_EQ(clear.clear[0].upper, box.upper);
    const RobotRange touching = RobotChecker(robot, &near).range(box);
    EXPECT_EQ(touching.verdict, RangeVerdict::contact);
    ASSERT_TRUE(touching.witness);
    EXPECT_GT(tip_of(*touching.witness) + tip_radius, reach - 1e-3);
}

/// A ball with a margin is a larger ball.
TEST(RobotRange, AMarginCountsAsContact) {
    const Robot robot = arm_beside_a_wall();
    const Scene scene = wall_at(1.2);
    const ConfigurationBox box = box_of_joints(robot, both, robot.neutral());
    RobotQuery query;
    query.options.margin = 0.2;
    const RobotRange found = RobotChecker(robot, &scene, query).range(box);
    const double truth = free_share(box, 1.2, tip_radius + 0.2);
    EXPECT_LT(found.clear_share, truth + 1e-3);
    EXPECT_GT(found.clear_share + found.open_share, truth - 1e-3);
    EXPECT_GT(found.contact_share, 0.9 * (1 - truth - found.open_share));
}

TEST(RobotRange, WhatIsAllowedIsNoContact) {
    Robot robot = arm_beside_a_wall();
    const Scene scene = wall_at(1.2);
    robot.ignore_in_scene("fore", "wall");
    const RobotRange found = RobotChecker(robot, &scene).range(box_of_joints(robot, both, robot.neutral()));
    EXPECT_EQ(found.verdict, RangeVerdict::clear);
    EXPECT_GT(found.untested->total(), 0U);
}

/// A box of two variables of a robot with limits or without, around a configuration.
ConfigurationBox random_box(Random& random, const Robot& robot) {
    ConfigurationBox box;
    box.lower = box.upper = random_configuration(random, robot, 1.5);
    for (const std::size_t first : robot.model().quaternions)
        box.lower.segment<4>(Eigen::Index(first)) = box.upper.segment<4>(Eigen::Index(first)) =
            Eigen::Vector4d(0.5, 0.5, -0.5, 0.5);
    for (int i = 0; i < 3; ++i) {
        const auto variable = Eigen::Index(random.integer(0, int(robot.variables().size()) - 1));
        if (robot.variables()[std::size_t(variable)].name.find("/rot_") == std::string::npos)
            box.upper[variable] = box.lower[variable] + random.uniform(0.1, 2);
    }
    return box;
}

/// Whether each point is in some box, and inner points in one alone.
void expect_partition(Random& random, const RobotRange& found, const ConfigurationBox& box) {
    std::vector<ConfigurationBox> all = found.clear;
    all.insert(all.end(), found.contact.begin(), found.contact.end());
    all.insert(all.end(), found.open.begin(), found.open.end());
    EXPECT_NEAR(found.clear_share + found.contact_share + found.open_share, 1, 1e-9);
    for (int i = 0; i < 100; ++i) {
        const Configuration q = sample(random, box);
        std::size_t around = 0, inside = 0;
        for (const ConfigurationBox& part : all) {
            around += part.contains(q) ? 1 : 0;
            bool is_inside = true;
            for (const std::size_t joint : found.joints) {
                const auto k = Eigen::Index(joint);
                is_inside = is_inside && q[k] > part.lower[k] && q[k] < part.upper[k];
            }
            inside += is_inside ? 1 : 0;
        }
        EXPECT_GE(around, 1U);
        EXPECT_LE(inside, 1U);
    }
}

TEST(RobotRange, SamplesOfRandomRobotsRefuteNothing) {
    Random random(4002);
    int clear_samples = 0, contact_samples = 0, witnesses = 0, clear = 0;
    for (int round = 0; round < 60; ++round) {
        Robot robot(random_robot(random, 5, round % 4 == 0));
        if (robot.variables().size() < 2)
            continue;
        Scene scene;
        std::mt19937 shapes(unsigned(round + 1));
        for (int i = 0; i < 3; ++i)
            scene.add({"body " + std::to_string(i), random_octahedron(shapes).polyhedron(),
                       Motion::at_rest(random_pose(random, 4))});
        RobotQuery query;
        query.options.margin = random.chance(0.3) ? random.uniform(0, 0.3) : 0;
        const RobotChecker checker(robot, &scene, query);
        const ConfigurationBox box = random_box(random, robot);
        if (box.lower == box.upper)
            continue;
        const RobotRange found = checker.range(box, {.tolerance = 0.05, .most_cells = 1500});
        expect_partition(random, found, box);
        witnesses += found.witness.has_value();
        clear += found.verdict == RangeVerdict::clear;
        EXPECT_FALSE(found.witness && checker.is_clear(*found.witness)) << round;
        for (int i = 0; i < 60 && !found.clear.empty(); ++i, ++clear_samples)
            EXPECT_TRUE(checker.is_clear(
                sample(random, found.clear[std::size_t(random.integer(0, int(found.clear.size()) - 1))])))
                << round;
        for (int i = 0; i < 60 && !found.contact.empty(); ++i, ++contact_samples)
            EXPECT_FALSE(checker.is_clear(
                sample(random, found.contact[std::size_t(random.integer(0, int(found.contact.size()) - 1))])))
                << round;
    }
    EXPECT_GT(clear_samples, 500);
    EXPECT_GT(contact_samples, 500);
    EXPECT_GT(witnesses, 10);
    EXPECT_GT(clear, 3);
}

bool are_same(const std::vector<ConfigurationBox>& a, const std::vector<ConfigurationBox>& b) {
    return std::ranges::equal(a, b,
                              [](const auto& x, const auto& y) { return x.lower == y.lower && x.upper == y.upper; });
}

TEST(RobotRange, IsTheSameForAnyNumberOfThreads) {
    const Robot robot = arm_beside_a_wall();
    const Scene scene = wall_at(1.2);
    const RobotChecker checker(robot, &scene);
    const ConfigurationBox box = box_of_joints(robot, both, robot.neutral());
    const RobotRange one = checker.range(box, {.threads = 1});
    for (const unsigned threads : {0U, 2U, 5U}) {
        const RobotRange many = checker.range(box, {.threads = threads});
        EXPECT_EQ(many.cells, one.cells);
        EXPECT_EQ(many.witness, one.witness);
        EXPECT_TRUE(are_same(many.clear, one.clear));
        EXPECT_TRUE(are_same(many.contact, one.contact));
        EXPECT_TRUE(are_same(many.open, one.open));
    }
}

double seconds_of(const std::function<void()>& work) {
    const auto start = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

TEST(RobotRange, KeepsEveryLimit) {
    const Robot robot = arm_beside_a_wall();
    const Scene scene = wall_at(1.2);
    const RobotChecker checker(robot, &scene);
    const ConfigurationBox box = box_of_joints(robot, both, robot.neutral());
    RobotRange found;
    EXPECT_LT(seconds_of([&] { found = checker.range(box, {.tolerance = 0, .seconds = 0.3}); }), 0.5);
    EXPECT_GT(found.open_share, 0);
    EXPECT_GT(found.clear_share, 0.1) << "what is proven stays";
    EXPECT_NEAR(found.clear_share + found.contact_share + found.open_share, 1, 1e-9);
    EXPECT_LT(seconds_of([&] {
                  const Limit limit(0.1);
                  found = checker.range(box, {.tolerance = 0});
              }),
              0.3);
    EXPECT_GT(found.open_share, 0);
    found = checker.range(box, {.most_cells = 7});
    EXPECT_EQ(found.cells, 7U);
    double decided = 0;
    found = checker.range(box, {.tolerance = 0, .progress = [&](double share) {
                                    EXPECT_GE(share, decided);
                                    decided = share;
                                    return share < 0.5;
                                }});
    EXPECT_GE(decided, 0.5);
    EXPECT_LT(decided, 0.99);
    EXPECT_LT(seconds_of([&] { (void)checker.clear_box(box, values(2, 0), {.tolerance = 0, .seconds = 0.2}); }), 0.4);
}

/// What no joint of the box moves is in contact everywhere, or nowhere.
TEST(RobotRange, PairsThatStandStillNeedOneCell) {
    RobotDescription description = arm_beside_a_wall().description();
    description.links[1].collisions = {{make_box({0.1, 0.1, 0.1}), shifted(0.5, 0, 0)}};
    description.links[0].collisions = {{make_box({0.1, 0.1, 0.1}), shifted(0.52, 0, 0)}};
    Robot robot(description);
    robot.test("base", "upper");
    robot.ignore("base", "fore");
    const RobotChecker checker(robot);
    const std::vector<std::string> elbow{"elbow"};
    const RobotRange found = checker.range(box_of_joints(robot, elbow, values(0, 0)));
    EXPECT_EQ(found.verdict, RangeVerdict::contact);
    EXPECT_EQ(found.contact_share, 1);
    EXPECT_EQ(found.cells, 1U);
    EXPECT_EQ(checker.range(box_of_joints(robot, elbow, values(1, 0))).verdict, RangeVerdict::clear);
    EXPECT_EQ(found.pair->first, "upper");
}

TEST(RobotRange, ContinuousJointsHaveOneTurn) {
    RobotDescription description = arm_beside_a_wall().description();
    for (JointDescription& joint : description.joints)
        joint.type = JointType::continuous;
    const Robot robot(description);
    const ConfigurationBox box = box_of_joints(robot, both, robot.neutral());
    EXPECT_GE(box.upper[0], std::numbers::pi);
    EXPECT_LE(box.lower[1], -std::numbers::pi);
    EXPECT_EQ(RobotChecker(robot).range(box).verdict, RangeVerdict::clear);
}

TEST(RobotRange, RefusesWhatIsNoBox) {
    const Robot robot = arm_beside_a_wall();
    const RobotChecker checker(robot);
    const auto why = [&](const ConfigurationBox& box, const RangeOptions& options = {}) {
        return refusal([&] { (void)checker.range(box, options); });
    };
    EXPECT_EQ(why({values(0, 0), values(0, 0)}),
              "range: box: no variable has a lower end below its upper end; is_clear answers for one configuration");
    EXPECT_EQ(why({values(0, 1), values(1, 0)}), "range: elbow: its lower end is above its upper end");
    EXPECT_EQ(why({values(0, 0), values(1, NAN)}), "range: upper: elbow is not a finite number");
    EXPECT_EQ(why({values(0, 0), Configuration::Ones(3)}), "range: upper: has 3 values, and the robot has 2 variables");
    EXPECT_NE(why({values(0, 0), values(1, 1001)}).find("range: upper: elbow is beyond 1000 radians"),
              std::string::npos);
    EXPECT_EQ(why({values(0, 0), values(1, 1)}, {.tolerance = 2}), "query: tolerance: must be in [0, 1]");
    EXPECT_EQ(why({values(0, 0), values(1, 1)}, {.seconds = NAN}), "query: seconds: must be positive");
    EXPECT_EQ(why({values(0, 0), values(1, 1)}, {.most_cells = 0}), "query: most_cells: must be positive");
    const std::vector<std::string> twice{"elbow", "elbow"}, unknown{"wrist"};
    EXPECT_EQ(refusal([&] { (void)box_of_joints(robot, twice, robot.neutral()); }), "range: elbow: comes twice");
    EXPECT_EQ(refusal([&] { (void)box_of_joints(robot, unknown, robot.neutral()); }),
              "robot: wrist: there is no such variable of a joint");
    Scene moving;
    moving.add({"cart", make_box({1, 1, 1}), Motion::velocity(Pose(), shifted(1, 0, 0))});
    EXPECT_EQ(
        refusal([&] {
            (void)RobotChecker(robot, &moving).range({values(0, 0), values(1, 1)});
        }),
        "range: cart: moves, and a range is about a world that stands still: leave its motion out, or give it the "
        "pose that it has at one time");
    EXPECT_EQ(refusal([&] {
                  (void)checker.clear_box({values(0, 0), values(1, 1)}, values(2, 0));
              }),
              "range: around: shoulder is 2, outside of the box, from 0 to 1");
    EXPECT_EQ(refusal([&] {
                  (void)checker.clear_box({values(0, 0), values(1, 0)}, values(0.5, 0.25));
              }),
              "range: around: elbow is 0.25, and the box holds it at 0: box_of_joints(joints, around) makes a box "
              "around it");
}

/// Files give joints that slide far such limits.
TEST(RobotRange, NamesALimitThatIsTooFar) {
    RobotDescription description = arm_beside_a_wall().description();
    description.joints[1].upper = 999999;
    const Robot robot(description);
    ConfigurationBox box = box_of_joints(robot, both, robot.neutral());
    EXPECT_EQ(refusal([&] { (void)RobotChecker(robot).range(box); }),
              "range: upper: elbow: its limit 999999 is beyond 1000 in magnitude, the largest value: give the box "
              "smaller ends of this variable");
    box.upper[1] = 0.1;
    (void)RobotChecker(robot).range(box);
}

TEST(RobotRange, RefusesQuaternionsAndSlidesWithoutLimits) {
    RobotDescription description = arm_beside_a_wall().description();
    description.joints[0].type = JointType::floating;
    description.joints[1].type = JointType::prismatic;
    description.joints[1].lower = -std::numeric_limits<double>::infinity();
    const Robot robot(description);
    ConfigurationBox box{robot.neutral(), robot.neutral()};
    box.upper[Eigen::Index(robot.variable("shoulder/rot_x"))] = 0.5;
    EXPECT_EQ(refusal([&] { (void)RobotChecker(robot).range(box); }),
              "range: shoulder/rot_x: is a part of a quaternion, which has to stand still: give it the same value at "
              "both ends");
    const std::vector<std::string> slide{"elbow"};
    EXPECT_EQ(refusal([&] { (void)box_of_joints(robot, slide, robot.neutral()); }),
              "range: elbow: has no limits; give the ends of its range");
}

} // namespace
} // namespace chasles::test
