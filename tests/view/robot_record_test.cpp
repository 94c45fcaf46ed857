// The page of a robot: links that turn many times, joints that follow others with a factor, and bodies of the world.
#include "view/robot_record.h"

#include "tests/query/bodies.h"

#include <cmath>
#include <gtest/gtest.h>
#include <memory>
#include <numbers>

namespace chasles {
namespace {

constexpr double turn = 2 * std::numbers::pi;

/// A shaft that turns, and a wheel on it that turns `factor` times as far.
RobotDescription shaft_with_wheel(double factor) {
    const Polyhedron box = test::box({0.5, 0.4, 0.3}).polyhedron();
    RobotDescription robot{"shaft with wheel"};
    robot.links = {{"base"}, {"shaft", {{box}}}, {"wheel", {{box, test::shifted(0, 0, 5)}}}};
    robot.joints = {{.name = "a", .type = JointType::continuous, .parent = "base", .child = "shaft"},
                    {.name = "b", .type = JointType::continuous, .parent = "shaft", .child = "wheel"}};
    robot.joints[1].mimic = MimicDescription{"a", factor, 0};
    return robot;
}

JointPath turning(const Robot& robot, double angle) {
    return JointPath::polynomials(robot, {{.coefficients = Eigen::Vector2d(0, angle)}});
}

/// As a checker answers: what was not tested is never null.
RobotAnswer answer_of(Verdict verdict) {
    RobotAnswer answer;
    answer.verdict = verdict;
    answer.untested = std::make_shared<const UntestedPairs>();
    return answer;
}

double largest_step(const std::vector<view::PoseRow>& rows) {
    double largest = 0;
    for (std::size_t i = 1; i < rows.size(); ++i) {
        const auto rotation = [](const view::PoseRow& r) { return Eigen::Quaterniond(r[3], r[4], r[5], r[6]); };
        EXPECT_GT(rotation(rows[i - 1]).dot(rotation(rows[i])), 0.6) << "the page interpolates the signs as they are";
        largest = std::max(largest, rotation(rows[i - 1]).angularDistance(rotation(rows[i])));
    }
    return largest;
}

TEST(RobotRecord, NoLinkTurnsFarInOneStep) {
    for (const double turns : {0.5, 1.0, 200.0, 400.0})
        for (const double factor : {-1.0, 0.3, 7.0}) {
            const Robot robot(shaft_with_wheel(factor));
            const double angle = std::min({turns * turn, 900.0, 1900 / std::abs(factor)}); // within the limits of paths
            const view::SceneRecord record =
                view::robot_record(robot, nullptr, turning(robot, angle), answer_of(Verdict::clear));
            ASSERT_EQ(record.bodies.size(), 2U);
            EXPECT_GE(double(record.times.size()), angle * std::max(1.0, std::abs(1 + factor)) / 1.6);
            for (const view::RecordedBody& body : record.bodies)
                EXPECT_LE(largest_step(body.poses), 1.6) << turns << " " << factor << " " << body.name;
        }
}

/// A page says what is proven. That of a recording says only what was recorded.
TEST(RobotRecord, IsAnAnswer) {
    const Robot robot(shaft_with_wheel(1));
    RobotAnswer answer = answer_of(Verdict::clear);
    answer.clear_until = 1;
    const view::SceneRecord record = view::robot_record(robot, nullptr, turning(robot, 0.1), answer);
    EXPECT_EQ(record.source, view::RecordSource::first_contact);
    EXPECT_EQ(record.clear_until, 1);
}

TEST(RobotRecord, BodiesOfTheWorldHaveTimesOfTheirOwn) {
    const Robot robot(shaft_with_wheel(1));
    Scene world;
    const Polyhedron box = test::box({0.5, 0.4, 0.3}).polyhedron();
    world.add({"fan", box, Motion::hinge({50, 0, 0}, {0, 0, 1}, {0, 30 * turn})});
    world.add({"post", box, Motion::at_rest(test::shifted(90, 0, 0))});
    RobotAnswer answer = answer_of(Verdict::contact);
    answer.time = {0.7, 0.7};
    const view::SceneRecord record = view::robot_record(robot, &world, turning(robot, 0.1), answer);
    EXPECT_NO_THROW(view::require_valid(record));
    const view::RecordedBody &fan = record.bodies[2], &post = record.bodies[3];
    EXPECT_EQ(post.poses.size(), 1U);
    EXPECT_EQ(fan.times.back(), 0.7) << "the page ends at the contact";
    EXPECT_GE(fan.times.size(), std::size_t(4 * 30 * 0.7));
    EXPECT_LE(largest_step(fan.poses), 1.6);
    const Eigen::Vector3d last(fan.poses.back()[0], fan.poses.back()[1], fan.poses.back()[2]);
    EXPECT_LE((last - world.bodies()[0].motion.pose_at(0.7).translation).norm(), 1e-12);
}

} // namespace
} // namespace chasles
