// Paths in joint space: where they go, and what is refused.
#include "chasles/robot/joint_path.h"

#include "chasles/algebra/double_double.h"
#include "chasles/base/invalid_input.h"
#include "chasles/robot/model.h"
#include "tests/robot/random_paths.h"
#include "tests/support/refusal.h"

#include <gtest/gtest.h>

namespace chasles::test {
namespace {

TEST(JointPath, GoesStraightAndTheShorterWayRound) {
    const Robot robot = three_joint_robot();
    Configuration start(3), goal(3);
    start << 0.5, 3, 1;
    goal << -3, -3, 2;
    const JointPath path = JointPath::straight(robot, std::array{start, goal});
    const Configuration middle = path.at(0.5);
    EXPECT_NEAR(middle[0], -1.25, 1e-15);
    EXPECT_NEAR(middle[1], std::numbers::pi, 1e-15) << "on from 3, not back through 0";
    EXPECT_NEAR(middle[2], 1.5, 1e-15);
    EXPECT_NEAR(path.at(1)[1], 2 * std::numbers::pi - 3, 1e-15);
    EXPECT_EQ(path.at(-1), start);
    EXPECT_EQ(path.at(7), path.at(1));
}

/// A continuous joint, a joint of this type that follows it, and one that follows that joint.
Robot led_robot(JointType type, double multiplier, JointType last = JointType::revolute, double last_multiplier = 1) {
    RobotDescription robot{"led"};
    robot.links = {{"base"}, {"wheel"}, {"led"}, {"last"}};
    robot.joints = {{"spin", JointType::continuous, "base", "wheel"},
                    {"follower", type, "base", "led"},
                    {"last", last, "base", "last"}};
    robot.joints[1].mimic = MimicDescription{"spin", multiplier, 0.25};
    robot.joints[2].mimic = MimicDescription{"follower", last_multiplier, 0};
    return Robot(robot);
}

/// The middle of the way from 2.5 to -2.8, at whose end each link has to be where the goal has it.
double middle_of_way(const Robot& robot) {
    const Configuration start{{2.5}}, goal{{-2.8}};
    const JointPath path = JointPath::straight(robot, std::array{start, goal});
    for (const LinkDescription& link : robot.description().links) {
        const Pose end = robot.link_pose(link.name, path.at(1)), wanted = robot.link_pose(link.name, goal);
        EXPECT_TRUE(end.isometry().isApprox(wanted.isometry(), 1e-12)) << link.name;
    }
    return path.at(0.5)[0];
}

/// A turn of the leader is a slide of a rack, and half a turn of a wheel twice as large: other configurations.
TEST(JointPath, GoesTheShorterWayRoundOnlyWhereFollowersDoSo) {
    const double shorter = std::numbers::pi - 0.15, straight = -0.15;
    using enum JointType;
    for (const double multiplier : {-1.0, 2.0, 0.0}) {
        EXPECT_NEAR(middle_of_way(led_robot(revolute, multiplier)), shorter, 1e-12);
        EXPECT_TRUE(led_robot(continuous, multiplier).variables()[0].is_continuous);
    }
    EXPECT_NEAR(middle_of_way(led_robot(revolute, 4, revolute, 0.25)), shorter, 1e-12) << "1 in all";
    EXPECT_NEAR(middle_of_way(led_robot(prismatic, 0.1)), straight, 1e-12);
    EXPECT_NEAR(middle_of_way(led_robot(revolute, 0.5)), straight, 1e-12);
    EXPECT_NEAR(middle_of_way(led_robot(continuous, -1.5)), straight, 1e-12);
    EXPECT_NEAR(middle_of_way(led_robot(revolute, 1, prismatic)), straight, 1e-12) << "a follower of a follower";
    EXPECT_NEAR(middle_of_way(led_robot(revolute, 2, revolute, 0.25)), straight, 1e-12) << "0.5 in all";
    EXPECT_FALSE(led_robot(prismatic, 0.1).variables()[0].is_continuous);
}

/// What makes values smaller depends on what they are.
TEST(JointPath, SaysHowLargeValuesBecomeSmaller) {
    const auto refused = [](const Robot& robot, Eigen::Index variable) {
        Configuration far = robot.neutral();
        far[variable] = -1000.5;
        return refusal([&] { (void)JointPath::straight(robot, std::array{far, far}); });
    };
    const std::string beyond = " is beyond 1000, the largest value: ",
                      turns = " is beyond 1000 radians (57295.8 degrees), the largest value: take whole turns off all "
                              "its values";
    EXPECT_EQ(refused(three_joint_robot(), 0), "path: configuration 0: turn" + turns);
    EXPECT_EQ(refused(three_joint_robot(), 2),
              "path: configuration 0: slide" + beyond + "choose a larger unit of length");
    EXPECT_EQ(refused(led_robot(JointType::prismatic, 0.1), 0),
              "path: configuration 0: spin" + turns +
                  ", and add each turn times the multiplier to the offset of a joint that follows it");
    RobotDescription free{"free"};
    free.links = {{"base"}, {"cart"}, {"body"}};
    free.joints = {{"plane", JointType::planar, "base", "cart"}, {"float", JointType::floating, "cart", "body"}};
    const Robot robot(free);
    EXPECT_EQ(refused(robot, 2), "path: configuration 0: plane/theta" + turns);
    EXPECT_EQ(refused(robot, 0), "path: configuration 0: plane/x" + beyond + "choose a larger unit of length");
    EXPECT_EQ(refused(robot, 6), "path: configuration 0: float/rot_x" + beyond + "give the quaternion the length 1");
    const Configuration largest = Configuration::Constant(3, 1000);
    EXPECT_EQ(JointPath::straight(three_joint_robot(), std::array{largest, largest}).at(0), largest);
}

/// The rate of an order at an end of a segment, by its coefficients.
Configuration rate(const JointPath::Segment& segment, int order, bool at_end) {
    Configuration sum = Configuration::Zero(segment.coefficients.cols());
    for (Eigen::Index k = order; k < segment.coefficients.rows(); ++k) {
        double factor = 1;
        for (int i = 0; i < order; ++i)
            factor *= double(k - i) / (segment.end - segment.begin);
        if (at_end || k == order)
            sum += factor * segment.coefficients.row(k).transpose();
    }
    return sum;
}

TEST(JointPath, SplinesHaveTheGivenRates) {
    Random random(2101);
    const Robot robot = three_joint_robot();
    for (int trial = 0; trial < 50; ++trial) {
        const std::size_t count = std::size_t(random.integer(2, 6));
        const std::vector<double> times = random_stamps(random, count);
        const auto p = random_configurations(random, three_joint_robot(), count, 2),
                   v = random_configurations(random, three_joint_robot(), count, 2),
                   a = random_configurations(random, three_joint_robot(), count, 2);
        const JointPath cubic = JointPath::cubic(robot, times, p, v);
        const JointPath quintic = JointPath::quintic(robot, times, p, v, a);
        for (std::size_t i = 0; i + 1 < count; ++i)
            for (const std::size_t end : {0U, 1U}) {
                for (const JointPath* path : {&cubic, &quintic}) {
                    EXPECT_LT((rate(path->segments()[i], 0, end == 1) - p[i + end]).norm(), 1e-12);
                    EXPECT_LT((rate(path->segments()[i], 1, end == 1) - v[i + end]).norm(), 1e-10);
                    EXPECT_LT((path->at(times[i + end]) - p[i + end]).norm(), 1e-12);
                }
                EXPECT_LT((rate(quintic.segments()[i], 2, end == 1) - a[i + end]).norm(), 1e-8);
            }
    }
}

TEST(JointPath, ANaturalSplineIsSmoothAndEndsWithoutAcceleration) {
    Random random(2102);
    const Robot robot = three_joint_robot();
    for (int trial = 0; trial < 50; ++trial) {
        const std::size_t count = std::size_t(random.integer(2, 8));
        const std::vector<double> times = random_stamps(random, count);
        const auto p = random_configurations(random, three_joint_robot(), count, 2);
        const JointPath path = JointPath::natural_spline(robot, times, p);
        const auto acceleration = [&](std::size_t segment, int end) {
            return rate(path.segments()[segment], 2, end == 1);
        };
        EXPECT_LT(acceleration(0, 0).norm(), 1e-8);
        EXPECT_LT(acceleration(count - 2, 1).norm(), 1e-8);
        for (std::size_t i = 0; i + 2 < count; ++i)
            EXPECT_LT((acceleration(i, 1) - acceleration(i + 1, 0)).norm(), 1e-8);
        for (std::size_t i = 0; i < count; ++i)
            EXPECT_LT((path.at(times[i]) - p[i]).norm(), 1e-12);
    }
}

/// In double, start + (goal - start) may miss the goal by a rounding; something thin may be in the gap.
TEST(JointPath, StraightSegmentsMeetWithoutAGap) {
    Random random(2103);
    const Robot robot = three_joint_robot();
    std::size_t gaps_in_double = 0;
    for (int trial = 0; trial < 200; ++trial) {
        auto p = random_configurations(random, three_joint_robot(), 3, 1);
        p[0] /= 3; // so that differences are rounded
        p[1] /= 7;
        const JointPath path = JointPath::straight(robot, p);
        const robot::SegmentMotion first = robot.model().motion_of(path.segments()[0]);
        const robot::SegmentMotion second = robot.model().motion_of(path.segments()[1]);
        for (std::size_t group = 1; group < robot.model().groups.size(); ++group) {
            const algebra::DoubleDouble end = first.values[group][0]->at(algebra::DoubleDouble(1.0));
            const algebra::DoubleDouble begin = second.values[group][0]->at(algebra::DoubleDouble(0.0));
            EXPECT_LE(std::abs(double(end - begin)), 0x1p-98);
        }
        for (Eigen::Index i = 0; i < 3; ++i)
            gaps_in_double += p[0][i] + (p[1][i] - p[0][i]) != p[1][i];
    }
    EXPECT_GT(gaps_in_double, 20U);
}

TEST(JointPath, RefusesWhatItCannotFollow) {
    const Robot robot = three_joint_robot();
    const Configuration zero = Configuration::Zero(3);
    Configuration bad = zero;
    const auto straight = [&](const std::vector<Configuration>& way) {
        return refusal([&] { (void)JointPath::straight(robot, way); });
    };
    EXPECT_EQ(
        straight({zero}),
        "path: configurations: there must be at least two, and there are 1; repeat it to ask about this one at rest");
    EXPECT_EQ(straight({}), "path: configurations: there must be at least two, and there are 0");
    EXPECT_EQ(straight({zero, Configuration::Zero(2)}),
              "path: configuration 1: has 2 values, and the robot has 3 variables");
    bad[1] = std::nan("");
    EXPECT_EQ(straight({zero, zero, bad}), "path: configuration 2: spin is not a finite number");
    bad[1] = 1001;
    EXPECT_EQ(straight({bad, zero}),
              "path: configuration 0: spin is beyond 1000 radians (57295.8 degrees), the largest "
              "value: take whole turns off all its values");
    const std::array way{zero, zero};
    const auto timed = [&](const std::vector<double>& times) {
        return refusal([&] { (void)JointPath::straight(robot, way, times); });
    };
    EXPECT_EQ(timed({0}), "path: times: there are 1 for 2 configurations");
    EXPECT_EQ(timed({1, 1}), "path: time 1: must be finite and later than the one before");
    EXPECT_EQ(timed({-1.7e308, 1.7e308}), "path: time 1: must be finite and later than the one before");
    EXPECT_EQ(refusal([&] {
                  const Configuration fast = Configuration::Constant(3, 1e308);
                  (void)JointPath::cubic(robot, std::array{0.0, 1e10}, way, std::array{fast, fast});
              }),
              "path: segment 0: a coefficient is not a finite number");
    EXPECT_EQ(refusal([&] {
                  (void)JointPath::cubic(robot, std::array{0.0, 1.0}, way, std::array{zero});
              }),
              "path: velocity: there are 1 for 2 times");
    const auto polynomials = [&](std::vector<JointPath::Segment> segments) {
        return refusal([&] { (void)JointPath::polynomials(robot, std::move(segments)); });
    };
    const Eigen::MatrixXd rows = Eigen::MatrixXd::Ones(2, 3);
    EXPECT_EQ(polynomials({}), "path: segments: there is none");
    EXPECT_EQ(polynomials({{0, 1, Eigen::MatrixXd::Ones(2, 2)}}),
              "path: segment 0: coefficients must have a row for each power and a column for each variable");
    EXPECT_EQ(polynomials({{0, 1, rows}, {1, 2, rows}}), "path: segment 1: does not begin where the one before ends");
    EXPECT_EQ(polynomials({{1, 1, rows}}), "path: segment 0: must end later than it begins");
    EXPECT_EQ(polynomials({{0, 1, 501 * rows}}),
              "path: segment 0: the coefficients of turn sum up to more than 1000, the largest value: divide the "
              "segment, or take whole turns off all its values");
}

} // namespace
} // namespace chasles::test
