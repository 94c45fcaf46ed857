// Links inside of obstacles and of each other: no culling of robots skips them.
#include "chasles/mesh/primitives.h"
#include "chasles/robot/pair_proof.h"
#include "chasles/robot/robot.h"
#include "tests/robot/turning_arm.h"
#include "tests/support/random_poses.h"

#include <gtest/gtest.h>

namespace chasles::test {
namespace {

Configuration at(double angle) {
    return Configuration::Constant(1, angle);
}

TEST(InsideOfRobots, ALinkInAnObstacleIsAContactAtTheStart) {
    const Polyhedron ball = enclosing_sphere(0.1, 0.001).shape;
    const Robot robot = turning_arm(ball, 1);
    Scene scene;
    scene.add({"hall", make_box({9, 9, 9}), Motion::at_rest(Pose())});
    Scene hollow;
    const Polyhedron box = make_box({9, 9, 9});
    std::vector<std::vector<std::uint32_t>> faces;
    for (std::size_t face = 0; face < box.face_count(); ++face)
        faces.emplace_back(box.face(face).begin(), box.face(face).end());
    hollow.add(
        {"hall", Polyhedron::from_polygons(box.vertices(), faces, {.solid = Solid::no}), Motion::at_rest(Pose())});
    const RobotChecker checker(robot, &scene), free(robot, &hollow);
    for (const double way : {0.0, 1e-3, 0.3, 3.0}) {
        const RobotAnswer found = checker.first_contact(at(-1), at(-1 + way));
        ASSERT_EQ(found.verdict, Verdict::contact_at_start) << way;
        ASSERT_TRUE(found.contact.inside);
        EXPECT_TRUE(found.contact.inside->moving_is_inside);
        EXPECT_EQ(found.clear_until, 0);
        EXPECT_FALSE(checker.is_clear(at(-1), at(-1 + way)));
        EXPECT_TRUE(free.is_clear(at(-1), at(-1 + way)));
    }
    EXPECT_FALSE(checker.is_clear(at(0)));
    EXPECT_TRUE(free.is_clear(at(0)));
    EXPECT_EQ(checker.least_distance(at(0), at(1)).distance.upper, 0);
}

TEST(InsideOfRobots, LinksThatAreAlwaysInEachOtherAlwaysTouch) {
    const Polyhedron ball = enclosing_sphere(0.1, 0.001).shape;
    const auto reason = [&](const std::vector<CollisionDescription>& base, double distance) {
        Robot robot = turning_arm(ball, distance, base);
        robot.test("base", "arm");
        return prove_pairs(robot).front().reason;
    };
    EXPECT_EQ(reason({{make_box({4, 4, 4})}}, 1), PairReason::always);
    EXPECT_EQ(reason({{make_box({4, 4, 4})}}, 5), PairReason::never);
    EXPECT_EQ(reason({{make_box({4, 4, 4}), Pose(Eigen::Vector3d(3, 0, 0), Eigen::Quaterniond::Identity())}}, 2),
              PairReason::sometimes);
}

} // namespace
} // namespace chasles::test
