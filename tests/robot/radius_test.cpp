// Round links and obstacles: culling of robots knows their radii, and URDF files may be given one.
#include "chasles/mesh/primitives.h"
#include "chasles/robot/pair_proof.h"
#include "chasles/robot/robot.h"
#include "tests/robot/turning_arm.h"
#include "tests/support/random_poses.h"
#include "tests/support/refusal.h"

#include <gtest/gtest.h>
#include <numbers>

namespace chasles::test {
namespace {

Configuration at(double angle) {
    return Configuration::Constant(1, angle);
}

TEST(RoundLinks, MeetObstaclesAtTheAngleOfTheClosedForm) {
    const Pose away({0, 0, 9}, Eigen::Quaterniond::Identity());
    const Robot robot = turning_arm(make_sphere(0.3), 2, {{make_sphere(0.1), away}});
    for (const double radius : {0.01, 0.2, 1.0}) {
        Scene scene;
        scene.add({"ball", make_sphere(radius), Motion::at_rest(Pose({0, 2, 0}, Eigen::Quaterniond::Identity()))});
        const RobotChecker checker(robot, &scene);
        const double reach = radius + 0.3; // a chord of the circle of radius 2
        const double angle = std::numbers::pi / 2 - 2 * std::asin(reach / 4);
        const RobotAnswer found = checker.first_contact(at(0), at(3));
        ASSERT_EQ(found.verdict, Verdict::contact);
        EXPECT_NEAR(found.contact.time.lower, angle / 3, 1e-11);
        EXPECT_TRUE(checker.is_clear(at(0), at(angle - 1e-9)));
        EXPECT_FALSE(checker.is_clear(at(0), at(angle + 1e-9)));
        const double least = 2 * std::sqrt(2.0) - reach;
        EXPECT_NEAR(checker.least_distance(at(0), at(0)).distance.upper, least, 1e-5 * least);
    }
}

// Of each point the first angle at which a sphere on an arm of length 2 meets it. Most points lie just beside its way.
TEST(RoundLinks, InACloudMeetAtTheAngleOfTheClosedForm) {
    Random random(4414);
    const double radius = 0.01, reach = 0.05 + radius, end = 3;
    const Robot robot = turning_arm(make_sphere(0.05), 2);
    int contacts = 0, clear = 0;
    for (int round = 0; round < 40; ++round) {
        std::vector<Eigen::Vector3d> points;
        double first = end;
        const int in_the_way = random.integer(0, 2);
        for (int i = 0; i < 6000; ++i) { // 11,999 nodes
            const double around = random.uniform(0.2, 6), across = random.uniform(0, 6.2),
                         away = i < in_the_way ? random.uniform(0, 0.9) * reach
                                               : reach * (1 + 1e-4) + random.uniform(0, 1);
            const double from_axis = 2 + away * std::cos(across), height = away * std::sin(across);
            points.emplace_back(from_axis * std::cos(around), from_axis * std::sin(around), height);
            const double square = from_axis * from_axis + height * height;
            const double cosine = (square + 4 - reach * reach) / (4 * from_axis);
            if (cosine < 1)
                first = std::min(first, around - std::acos(cosine));
        }
        Scene scene;
        scene.add({"cloud", make_points(points, radius), Motion::at_rest(Pose())});
        const RobotChecker checker(robot, &scene);
        const RobotAnswer found = checker.first_contact(at(0), at(end));
        ASSERT_EQ(found.verdict, first < end ? Verdict::contact : Verdict::clear) << round;
        EXPECT_EQ(checker.is_clear(at(0), at(end)), first == end);
        EXPECT_NEAR(found.verdict == Verdict::clear ? end : found.contact.time.lower * end, first, 1e-9);
        ++(first < end ? contacts : clear);
    }
    EXPECT_GT(contacts, 10);
    EXPECT_GT(clear, 10);
}

TEST(RoundLinks, AnswerAsLinksWithALargerMargin) {
    Random random(4413);
    int contacts = 0, clear = 0;
    for (int round = 0; round < 200; ++round) {
        const auto box = [&] {
            return make_box({random.uniform(0.1, 0.8), random.uniform(0.1, 0.8), random.uniform(0.1, 0.8)});
        };
        const Polyhedron moving = box(), fixed = box(), obstacle = box();
        const Pose fixed_at = random_pose(random, 2), obstacle_at = random_pose(random, 2);
        const double a = random.integer(0, 16) * 0x1p-6;
        const auto answer = [&](double radius, double margin) {
            Scene scene;
            scene.add({"obstacle", obstacle.with_radius(radius), Motion::at_rest(obstacle_at)});
            const Robot robot = turning_arm(moving.with_radius(radius), 1, {{fixed.with_radius(radius), fixed_at}});
            return RobotChecker(robot, &scene, {.options = {.margin = margin}}).first_contact(at(0), at(3));
        };
        const RobotAnswer round_bodies = answer(a, 0x1p-6), plain = answer(0, 0x1p-6 + 2 * a);
        ASSERT_EQ(round_bodies.verdict, plain.verdict) << round;
        EXPECT_NEAR(round_bodies.contact.time.lower, plain.contact.time.lower, 3e-12) << round;
        ++(plain.verdict == Verdict::clear ? clear : contacts);
    }
    EXPECT_GT(contacts, 20);
    EXPECT_GT(clear, 20);
}

TEST(RoundLinks, AreEnclosedInAShapeOfTheWholeRobot) {
    const Robot robot = turning_arm(make_sphere(0.3), 2, {{make_capsule(0.5, 1), Pose()}});
    const MeshReport report = robot.shape(at(0)).report();
    EXPECT_EQ(report.solid_parts, 2U);
    EXPECT_GE(report.upper.x(), 2.3);
    EXPECT_LE(report.upper.x(), 2.3 + 0.0031);
    EXPECT_GE(report.lower.z(), -1.006);
    EXPECT_LE(report.lower.z(), -1);
    EXPECT_NEAR(robot.shape(at(0), {.radius = 0.5}).report().upper.x(), 2.8, 0.0031);
    const Robot mesh = turning_arm(make_box({1, 1, 1}).with_radius(0.1), 2, {{make_sphere(1), Pose()}});
    EXPECT_NE(refusal([&] { (void)mesh.shape(at(0)); }).find("has meshes with a radius"), std::string::npos);
}

TEST(RoundLinks, OfOneRadiusAreExactInAShapeOfTheWholeRobot) {
    const Robot robot = turning_arm(make_sphere(0.3), 2, {{make_capsule(0.3, 1), Pose()}});
    const Polyhedron shape = robot.shape(at(0));
    EXPECT_EQ(shape.radius(), 0.3);
    EXPECT_EQ(shape.vertex_count(), 3U);
    EXPECT_NEAR(shape.report().upper.x(), 2.3, 1e-15);
    EXPECT_NEAR(shape.report().lower.z(), -0.8, 1e-15);
    EXPECT_EQ(robot.shape(at(0), {.solid = Solid::yes}).radius(), 0.3);
    EXPECT_EQ(robot.shape(at(0), {.radius = 0.2}).radius(), 0.5);
    EXPECT_EQ(robot.shape(at(0), {.radius = -0.1}).report().moved_inwards, 0);
    EXPECT_NEAR(robot.shape(at(0), {.radius = -0.1}).radius(), 0.2, 1e-15);
    EXPECT_EQ(refusal([&] { (void)robot.shape(at(0), {.radius = -0.4}); }),
              "radius: that of the shape, 0.3, and the added one, -0.4, must be above 0 together");
    const Polyhedron surface = robot.shape(at(0), {.solid = Solid::no});
    EXPECT_EQ(surface.radius(), 0) << "a radius has an inside";
    EXPECT_GT(surface.face_count(), 100U);
}

TEST(RoundLinks, ThatAlwaysOverlapAreProven) {
    for (const double radius : {0.4, 0.75}) { // 1 from the axis: apart or in each other
        Robot robot = turning_arm(make_sphere(radius), 1, {{make_sphere(radius), Pose()}});
        robot.test("base", "arm");
        const auto proofs = prove_pairs(robot);
        ASSERT_EQ(proofs.size(), 1U);
        EXPECT_EQ(proofs[0].reason == PairReason::always, radius > 0.5) << radius;
    }
}

} // namespace
} // namespace chasles::test
