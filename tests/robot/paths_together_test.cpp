// Paths of several robots with stamps of their own, cut at all stamps: against exact rationals.
#include "chasles/algebra/sine_cosine.h"
#include "chasles/robot/model.h"
#include "tests/robot/random_paths.h"
#include "tests/support/rational.h"
#include "tests/support/refusal.h"

#include <gtest/gtest.h>
#include <numbers>

namespace chasles::test {
namespace {

using Segment = JointPath::Segment;

Robot free_body() {
    RobotDescription robot{"free"};
    robot.links = {{"base"}, {"body"}};
    robot.joints = {{"float", JointType::floating, "base", "body"}};
    return Robot(robot);
}

JointPath some_path(Random& random, const Robot& robot) {
    const auto count = std::size_t(random.integer(2, 5));
    const std::vector<double> stamps = random_stamps(random, count);
    const bool is_far = random.chance(0.3); // from -300 to 300, digits of the middle would cancel
    const auto p = random_configurations(random, robot, count, is_far ? 60 : 3),
               far = random_configurations(random, robot, count, is_far ? 300 : 3),
               v = random_configurations(random, robot, count, 2), a = random_configurations(random, robot, count, 2);
    switch (random.integer(0, 3)) {
    case 0:
        return JointPath::straight(robot, far, stamps);
    case 1:
        return JointPath::natural_spline(robot, stamps, random_configurations(random, robot, count, 3));
    case 2:
        return JointPath::cubic(robot, stamps, p, v);
    default:
        return JointPath::quintic(robot, stamps, random_configurations(random, robot, count, 3), v, a);
    }
}

Rational exact_coefficient(const Segment& segment, Eigen::Index power, Eigen::Index variable) {
    if (power >= segment.coefficients.rows())
        return 0;
    const Rational high(segment.coefficients(power, variable));
    return segment.remainders.size() > 0 ? high + Rational(segment.remainders(power, variable)) : high;
}

/// The value of a path at a stamp, exactly; outside of the path at its nearer end.
Rational exact_value(const JointPath& path, std::size_t index, const Rational& stamp, Eigen::Index variable) {
    const Segment& segment = path.segments()[index];
    const Rational begin(segment.begin), end(segment.end);
    Rational share = (stamp - begin) / (end - begin), value = 0;
    share = std::clamp(share, Rational(0), Rational(1));
    for (Eigen::Index k = segment.coefficients.rows(); k-- > 0;)
        value = value * share + exact_coefficient(segment, k, variable);
    return value;
}

/// The segment that a stamp within another path's segment falls into.
std::size_t segment_at(const JointPath& path, double middle) {
    std::size_t found = 0;
    while (found + 1 < path.segments().size() && path.segments()[found].end <= middle)
        ++found;
    return found;
}

/// Compares the columns of a robot in a segment of the cell with its own path, at more places than the degree.
void expect_same_polynomial(const Segment& of_cell, Eigen::Index first, const JointPath& own, int& cuts) {
    const double middle = of_cell.begin + (of_cell.end - of_cell.begin) / 2;
    const std::size_t index = segment_at(own, middle);
    cuts += own.segments()[index].begin < of_cell.begin || of_cell.end < own.segments()[index].end;
    for (Eigen::Index i = 0; i < own.segments()[0].coefficients.cols(); ++i) {
        Rational size = 0;
        for (Eigen::Index k = 0; k < of_cell.coefficients.rows(); ++k)
            size += abs(exact_coefficient(of_cell, k, first + i));
        for (int part = 0; part <= 8; ++part) {
            const Rational share = Rational(part) / 8;
            const Rational begin(of_cell.begin), end(of_cell.end);
            Rational value = 0;
            for (Eigen::Index k = of_cell.coefficients.rows(); k-- > 0;)
                value = value * share + exact_coefficient(of_cell, k, first + i);
            const Rational error = abs(value - exact_value(own, index, begin + share * (end - begin), i));
            EXPECT_LE(error, size * Rational(0x1p-103) + Rational(0x1p-180)) << "variable " << i;
        }
    }
}

TEST(PathsTogether, ArePartsOfTheGivenPolynomialsToTheLastDigit) {
    Random random(4211);
    const Robot robot = three_joint_robot();
    const Robot cell = Robot::together({{"right", robot}, {"left", robot}});
    int cuts = 0;
    for (int trial = 0; trial < 100; ++trial) {
        const JointPath left = some_path(random, robot), right = some_path(random, robot);
        const JointPath both = JointPath::together(cell, {{"left", left}, {"right", right}});
        for (const Segment& segment : both.segments()) {
            expect_same_polynomial(segment, 0, right, cuts);
            expect_same_polynomial(segment, 3, left, cuts);
        }
        EXPECT_EQ(both.segments().front().begin, std::min(left.segments()[0].begin, right.segments()[0].begin));
        EXPECT_EQ(both.segments().back().end, std::max(left.segments().back().end, right.segments().back().end));
        EXPECT_EQ(both.knots(), JointPath::Knots::none);
    }
    EXPECT_GT(cuts, 300);
}

TEST(PathsTogether, OnOneClockAreWhatTheyWere) {
    Random random(4212);
    const Robot robot = three_joint_robot();
    const Robot cell = Robot::together({{"a", robot}, {"b", robot}});
    for (int trial = 0; trial < 20; ++trial) {
        const std::vector<double> stamps = random_stamps(random, 4);
        const auto p = random_configurations(random, robot, 4, 5), q = random_configurations(random, robot, 4, 5);
        std::vector<Configuration> joined;
        for (std::size_t i = 0; i < 4; ++i) {
            joined.emplace_back(6);
            joined.back() << p[i], q[i];
        }
        const JointPath expected = JointPath::straight(cell, joined, stamps);
        const JointPath found = JointPath::together(
            cell, {{"a", JointPath::straight(robot, p, stamps)}, {"b", JointPath::straight(robot, q, stamps)}});
        ASSERT_EQ(found.segments().size(), 3U);
        for (std::size_t s = 0; s < 3; ++s) {
            EXPECT_EQ(found.segments()[s].coefficients, expected.segments()[s].coefficients);
            EXPECT_EQ(found.segments()[s].remainders, expected.segments()[s].remainders);
            EXPECT_EQ(found.segments()[s].begin, stamps[s]);
        }
    }
}

/// Stamps that rounding has made different are two: the segment between them is as short as that.
TEST(PathsTogether, StampsMayBeNextToEachOther) {
    const Robot robot = three_joint_robot();
    const Robot cell = Robot::together({{"a", robot}, {"b", robot}});
    const std::array way{Configuration(Configuration::Zero(3)), Configuration(Configuration::Ones(3))};
    const double third = 0.1 + 0.2;
    const JointPath path = JointPath::together(cell, {{"a", JointPath::straight(robot, way, std::array{0.0, 0.3})},
                                                      {"b", JointPath::straight(robot, way, std::array{0.0, third})}});
    ASSERT_EQ(path.segments().size(), 2U);
    EXPECT_EQ(path.segments()[1].begin, 0.3);
    EXPECT_EQ(path.segments()[1].end, third);
    EXPECT_EQ(RobotChecker(cell).first_contact(path).verdict, Verdict::clear);
}

motion::Quaternion<DoubleDouble> orientation(const Robot& robot, const Segment& segment, const DoubleDouble& time) {
    const robot::SegmentMotion::Turn turn = robot.model().motion_of(segment).turns.begin()->second;
    const auto [sine, cosine] = algebra::sine_cosine(DoubleDouble(0.5) * turn.joint.value->at(time));
    return turn.start.refined.rotation * motion::Quaternion<DoubleDouble>{cosine, scale(turn.joint.axis.refined, sine)};
}

/// Parts of an even turn are even turns about the same axis, also of half a turn.
TEST(PathsTogether, PartsOfEvenTurnsGoWhereTheWholeGoes) {
    Random random(4213);
    const Robot body = free_body(), robot = three_joint_robot();
    const Robot cell = Robot::together({{"body", body}, {"arm", robot}});
    int parts = 0;
    for (int trial = 0; trial < 100; ++trial) {
        auto ends = random_configurations(random, body, 2, 2);
        if (trial % 4 == 0) { // half a turn about x
            ends[0].tail(4) << 0, 0, 0, 1;
            ends[1].tail(4) << 1, 0, 0, trial % 8 == 0 ? 0 : 1e-17;
        }
        const std::vector<double> stamps = random_stamps(random, 5);
        const JointPath own = JointPath::straight(body, ends, std::array{stamps.front(), stamps.back()});
        const JointPath both = JointPath::together(
            cell,
            {{"body", own}, {"arm", JointPath::straight(robot, random_configurations(random, robot, 5, 2), stamps)}});
        for (const Segment& segment : both.segments()) {
            Segment of_body = segment;
            of_body.coefficients = segment.coefficients.leftCols(7).eval();
            of_body.remainders = segment.remainders.leftCols(7).eval();
            for (const double time : {0.0, 0.3, 1.0}) {
                const DoubleDouble stamp =
                    DoubleDouble(segment.begin) + DoubleDouble(time) * (DoubleDouble(segment.end) - segment.begin);
                const DoubleDouble share = (stamp - stamps.front()) / (DoubleDouble(stamps.back()) - stamps.front());
                const auto found = orientation(body, of_body, time);
                const auto expected = orientation(body, own.segments()[0], share);
                const auto off = expected.conjugate() * found;
                EXPECT_LE(double(length(off.v)), 0x1p-95) << trial << ' ' << time;
                ++parts;
            }
        }
    }
    EXPECT_GT(parts, 1000);
}

TEST(PathsTogether, RobotsRestBeforeTheyBeginAndAfterTheyEnd) {
    Random random(4214);
    const Robot robot = three_joint_robot();
    const Robot cell = Robot::together({{"a", robot}, {"b", robot}, {"c", robot}, {"fixture", free_body()}});
    const auto p = random_configurations(random, robot, 3, 5), q = random_configurations(random, robot, 2, 5);
    const Configuration rest = random_configuration(random, robot);
    Configuration place = Configuration::Zero(7);
    place[6] = 1;
    const JointPath path = JointPath::together(cell, {{"a", JointPath::straight(robot, p, std::array{0.0, 1.0, 2.0})},
                                                      {"b", JointPath::straight(robot, q, std::array{5.0, 6.0})},
                                                      {"c", rest},
                                                      {"fixture", place}});
    ASSERT_EQ(path.segments().size(), 4U) << "0, 1, 2, 5, 6";
    for (const double stamp : {-1.0, 0.5, 2.0, 3.0, 5.0, 5.5, 7.0}) {
        const Configuration found = path.at(stamp);
        const Configuration of_a = JointPath::straight(robot, p, std::array{0.0, 1.0, 2.0}).at(stamp);
        const Configuration of_b = JointPath::straight(robot, q, std::array{5.0, 6.0}).at(stamp);
        EXPECT_LT((found.segment(0, 3) - of_a).norm(), 1e-14) << stamp;
        EXPECT_LT((found.segment(3, 3) - of_b).norm(), 1e-14) << stamp;
        EXPECT_EQ(found.segment(6, 3), rest);
        EXPECT_EQ(found.tail(7), place);
    }
}

TEST(PathsTogether, RefuseWhatIsNoPathOfTheCell) {
    const Robot robot = three_joint_robot(), body = free_body();
    const Robot cell = Robot::together({{"a", robot}, {"b", body}});
    const Configuration zero = Configuration::Zero(3);
    Configuration place = Configuration::Zero(7);
    const JointPath path = JointPath::straight(robot, std::array{zero, zero});
    const auto refused = [&](const JointPath::OfRobots& paths) {
        return refusal([&] { (void)JointPath::together(cell, paths); });
    };
    EXPECT_EQ(refused({{"a", path}}), "path: b: has no path; give one, or the configuration at which it rests");
    EXPECT_EQ(refused({{"a", path}, {"c", zero}}), "path: c: there is no such robot in the cell, which has a, b");
    EXPECT_EQ(refused({{"a", path}, {"b", zero}}), "path: b: has 3 values, and the robot has 7 variables");
    EXPECT_EQ(refused({{"a", path}, {"b", path}}), "path: b: has 3 variables, and the robot has 7 variables");
    EXPECT_EQ(refused({{"a", path}, {"b", place}}), "path: configuration 0: b/float/rot_x: the quaternion is zero");
    place[6] = 1;
    EXPECT_EQ(refused({{"a", zero}, {"b", place}}),
              "path: no robot of the cell has a path: for a cell at rest, make a straight path of its configuration "
              "twice");
    RobotDescription renamed = robot.description();
    renamed.joints[1].type = JointType::revolute;
    const JointPath of_other = JointPath::straight(Robot(renamed), std::array{zero, zero});
    EXPECT_EQ(refused({{"a", of_other}, {"b", place}}),
              "path: a: belongs to another robot: its variable 1 is spin, and that of the robot is spin, which is "
              "continuous");
    EXPECT_EQ(refusal([&] {
                  (void)JointPath::together(robot, {{"a", path}});
              }),
              "path: the variable turn is that of no robot of a cell; a cell is made by Robot::together");
    const double far = 1.7e308;
    const JointPath early = JointPath::straight(robot, std::array{zero, zero}, std::array{-far, 0.0});
    const JointPath late = JointPath::straight(robot, std::array{zero, zero}, std::array{0.0, far});
    EXPECT_EQ(refusal([&] {
                  (void)JointPath::together(Robot::together({{"a", robot}, {"b", robot}}), {{"a", early}, {"b", late}});
              }),
              "path: the stamps of the robots are too far from each other");
}

} // namespace
} // namespace chasles::test
