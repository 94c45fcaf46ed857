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
                view::robot_record(robot, nullptr, {turning(robot, angle), answer_of(Verdict::clear)});
            ASSERT_EQ(record.bodies.size(), 2U);
            EXPECT_GE(double(record.bodies[1].times.size()), angle * std::abs(1 + factor) / 1.6);
            for (const view::RecordedBody& body : record.bodies)
                EXPECT_LE(largest_step(body.poses), 1.6) << turns << " " << factor << " " << body.name;
        }
}

/// A page says what is proven. That of a recording says only what was recorded.
TEST(RobotRecord, IsAnAnswer) {
    const Robot robot(shaft_with_wheel(1));
    RobotAnswer answer = answer_of(Verdict::clear);
    answer.clear_until = 1;
    const view::SceneRecord record = view::robot_record(robot, nullptr, {turning(robot, 0.1), answer});
    EXPECT_EQ(record.source, view::RecordSource::first_contact);
    EXPECT_EQ(record.clear_until, 1);
}

/// The pose that a page shows: a linear step and a slerp.
Eigen::Isometry3d shown_at(const view::RecordedBody& body, double time) {
    const auto pose_of = [](const view::PoseRow& row) {
        return Pose({row[0], row[1], row[2]}, {row[3], row[4], row[5], row[6]});
    };
    if (body.poses.size() == 1)
        return pose_of(body.poses[0]).isometry();
    std::size_t i = 0;
    while (i + 2 < body.times.size() && body.times[i + 1] <= time)
        ++i;
    const double part = (time - body.times[i]) / (body.times[i + 1] - body.times[i]);
    const Pose from = pose_of(body.poses[i]), to = pose_of(body.poses[i + 1]);
    Eigen::Isometry3d shown(Eigen::Quaterniond(from.rotation).slerp(part, Eigen::Quaterniond(to.rotation)));
    shown.translation() = (1 - part) * from.translation + part * to.translation;
    return shown;
}

/// A path of many rows: what rests has one pose, what moves in a straight line or turns a little has one for each row,
/// and what turns far has as many as the rule asks for.
TEST(RobotRecord, LinksHaveAsManyPosesAsTheyNeed) {
    RobotDescription description = shaft_with_wheel(0);
    description.links.push_back({"tool", {{test::box({0.5, 0.4, 0.3}).polyhedron(), test::shifted(0, 3, 0)}}});
    description.joints[1] = {.name = "b", .type = JointType::prismatic, .parent = "shaft", .child = "wheel"};
    description.joints.push_back({.name = "c", .type = JointType::continuous, .parent = "base", .child = "tool"});
    const Robot robot(description);
    constexpr int rows = 500;
    std::vector<Configuration> way;
    for (int i = 0; i <= rows; ++i)
        way.emplace_back(Eigen::Vector3d(0, 0.01 * i, i < rows ? 0.002 * i : 0.002 * i + 1));
    const JointPath path = JointPath::straight(robot, way);
    const view::SceneRecord record = view::robot_record(robot, nullptr, {path, answer_of(Verdict::clear)});
    EXPECT_NO_THROW(view::require_valid(record));
    EXPECT_EQ(record.bodies[0].poses.size(), 1U) << "the shaft rests";
    EXPECT_EQ(record.bodies[1].poses.size(), rows + 1U) << "the wheel slides";
    EXPECT_GT(record.bodies[2].poses.size(), rows + 10U) << "the tool turns far in the last segment";
    EXPECT_LT(record.bodies[2].poses.size(), rows + 100U);
    const Eigen::AlignedBox3d box(Eigen::Vector3d(-0.5, -0.4, -0.3), Eigen::Vector3d(0.5, 0.4, 0.3));
    for (int i = 0; i <= 7919; ++i) {
        const double time = rows * (i / 7919.);
        const std::vector<Pose> links = robot.link_poses(path.at(time));
        for (std::size_t body = 0; body < 3; ++body) {
            const Pose place = description.links[body + 1].collisions[0].origin;
            const Eigen::Isometry3d there = links[body + 1].isometry() * place.isometry(),
                                    shown = shown_at(record.bodies[body], time);
            for (int k = 0; k < 8; ++k) {
                const Eigen::Vector3d corner = box.corner(Eigen::AlignedBox3d::CornerType(k));
                EXPECT_LE((there * corner - shown * corner).norm(), 1.2e-3 * box.diagonal().norm() + 6e-5) << time;
            }
        }
    }
}

TEST(RobotRecord, BodiesOfTheWorldHaveTimesOfTheirOwn) {
    const Robot robot(shaft_with_wheel(1));
    Scene world;
    const Polyhedron box = test::box({0.5, 0.4, 0.3}).polyhedron();
    world.add({"fan", box, Motion::hinge({50, 0, 0}, {0, 0, 1}, {0, 30 * turn})});
    world.add({"post", box, Motion::at_rest(test::shifted(90, 0, 0))});
    RobotAnswer answer = answer_of(Verdict::contact);
    answer.time = {0.7, 0.7};
    const view::SceneRecord record = view::robot_record(robot, &world, {turning(robot, 0.1), answer});
    EXPECT_NO_THROW(view::require_valid(record));
    const view::RecordedBody &fan = record.bodies[2], &post = record.bodies[3];
    EXPECT_EQ(post.poses.size(), 1U);
    EXPECT_EQ(fan.times.back(), 0.7) << "the page ends at the contact";
    EXPECT_GE(fan.times.size(), std::size_t(4 * 30 * 0.7));
    EXPECT_LE(largest_step(fan.poses), 1.6);
    const Eigen::Vector3d last(fan.poses.back()[0], fan.poses.back()[1], fan.poses.back()[2]);
    EXPECT_LE((last - world.bodies()[0].motion.pose_at(0.7).translation).norm(), 1e-12);
}

/// A part is on the shaft for a quarter of a turn, then on the base, and on the wheel at last.
TEST(RobotRecord, ABodyOfTheWorldMakesAShortStroke) {
    const Robot robot(shaft_with_wheel(1));
    Scene world;
    const Pose rest = test::shifted(90, 0, 60), tip = test::shifted(90, 0, 10);
    world.add({"punch", test::box({0.5, 0.4, 0.3}).polyhedron(),
               TimedPoses::through({0, 0.43, 0.445, 0.46, 1}, {rest, rest, tip, rest, rest})});
    const view::SceneRecord record =
        view::robot_record(robot, &world, {turning(robot, 0.1), answer_of(Verdict::clear)});
    double lowest = 60;
    for (const view::PoseRow& row : record.bodies.back().poses)
        lowest = std::min(lowest, row[2]);
    EXPECT_NEAR(lowest, 10, 2e-3);
}

TEST(RobotRecord, APartChangesHandsWhereItIs) {
    Robot robot(shaft_with_wheel(1));
    robot.attach({"part", "shaft", test::box({0.1, 0.1, 0.1}).polyhedron(), test::shifted(0, 2, 0)});
    std::vector<Configuration> way;
    for (const double angle : {0.0, 0.25, 0.5, 1.0})
        way.emplace_back(Configuration::Constant(1, angle * turn));
    const JointPath path = JointPath::straight(robot, way);
    RobotAnswer answer = answer_of(Verdict::clear);
    const std::vector<Handover> handovers{{1, "part", "base"}, {2, "part", "wheel"}};
    const view::SceneRecord record = view::robot_record(robot, nullptr, {path, answer, handovers});
    const view::RecordedBody& part = record.bodies[1];
    ASSERT_EQ(part.name, "part");
    const auto place = [&](double time) -> Eigen::Vector3d { return shown_at(part, time).translation(); };
    // joints turn about x; the wheel turns twice as far as the shaft
    EXPECT_LT((place(0) - Eigen::Vector3d(0, 2, 0)).norm(), 1e-12);
    for (const double time : {1.0, 1.3, 2.0})
        EXPECT_LT((place(time) - Eigen::Vector3d(0, 0, 2)).norm(), 1e-2) << time;
    EXPECT_LT((place(3) - Eigen::Vector3d(0, 0, 2)).norm(), 1e-12) << "a whole turn of the wheel";
    EXPECT_LT((place(2.5) - Eigen::Vector3d(0, 0, -2)).norm(), 1e-2) << "half a turn of the wheel";
}

} // namespace
} // namespace chasles
