// A robot as one rigid body.
#include "chasles/mesh/primitives.h"
#include "tests/robot/random_robot.h"
#include "tests/support/refusal.h"

#include <gtest/gtest.h>

namespace chasles::test {
namespace {

/// Every vertex of every shape, placed by hand.
TEST(RobotShape, HasAllShapesWhereTheLinksAre) {
    Random random(4103);
    for (int round = 0; round < 50; ++round) {
        RobotDescription description = random_robot(random, 5, false);
        description.links[0].collisions = {{make_box({1, 2, 3}), random_pose(random, 1)}};
        Robot robot(description);
        robot.attach({"part", description.links[1].name, make_box({1, 1, 1}), shifted(1, 2, 3), {}});
        robot.set_base(random_pose(random, 3));
        const Configuration q = random_configuration(random, robot);
        const Polyhedron shape = robot.shape(q);
        std::vector<Eigen::Vector3d> expected;
        const auto add = [&](const Polyhedron& of, const Eigen::Isometry3d& pose) {
            for (const Eigen::Vector3d& vertex : of.vertices())
                expected.push_back(pose * vertex);
        };
        for (const LinkDescription& link : description.links)
            for (const CollisionDescription& collision : link.collisions)
                add(collision.shape, robot.link_pose(link.name, q).isometry() * collision.origin.isometry());
        add(make_box({1, 1, 1}), robot.link_pose("part", q).isometry());
        ASSERT_EQ(shape.vertex_count(), expected.size());
        for (std::size_t i = 0; i < expected.size(); ++i)
            EXPECT_LT((shape.vertices()[i] - expected[i]).norm(), 1e-12) << i;
        EXPECT_TRUE(shape.report().closed);
    }
}

TEST(RobotShape, KeepsPolygonsThatStayPlanarAndCutsOthers) {
    RobotDescription fixture{"fixture"};
    fixture.links = {{"plate", {{make_box({4, 4, 1})}}}, {"post", {{make_box({1, 1, 2})}}}};
    fixture.joints = {{"glue", JointType::fixed, "plate", "post"}};
    fixture.joints[0].origin = shifted(0, 0, 1.5);
    const Robot straight(fixture);
    EXPECT_TRUE(straight.variables().empty());
    EXPECT_EQ(straight.shape(straight.neutral()).face_count(), 12U) << "the post stands on the plate";
    Robot turned(fixture);
    turned.set_base(Pose({0.1, 0.2, 0.3}, Eigen::Quaterniond(0.9, 0.1, 0.2, 0.3)));
    const Polyhedron shape = turned.shape(turned.neutral());
    EXPECT_GE(shape.face_count(), 12U);
    EXPECT_LE(shape.face_count(), 24U);
    EXPECT_EQ(refusal([] {
                  RobotDescription bare{"bare"};
                  bare.links = {{"only"}};
                  (void)Robot(bare).shape(Configuration(0));
              }),
              "robot: bare: has no collision shapes");
}

/// A robot without variables is asked about like any other.
TEST(RobotShape, ARobotWithoutVariablesIsAskedAboutAtRest) {
    RobotDescription fixture{"fixture"};
    fixture.links = {{"plate", {{make_box({4, 4, 1})}}}};
    const Robot robot(fixture);
    Scene scene;
    scene.add({"ball", make_box({1, 1, 1}), Motion::velocity(shifted(0, 0, 3), shifted(0, 0, 0))});
    const RobotAnswer found = RobotChecker(robot, &scene).first_contact(Configuration(0), Configuration(0));
    EXPECT_EQ(found.verdict, Verdict::contact);
    EXPECT_NEAR(found.time.lower, 2.0 / 3, 1e-9);
    EXPECT_EQ(RobotChecker(robot).first_contact(Configuration(0), Configuration(0)).verdict, Verdict::clear);
    scene.move(0, Motion::at_rest(shifted(0, 0, 0.5)));
    EXPECT_FALSE(RobotChecker(robot, &scene).is_clear(Configuration(0)));
}

} // namespace
} // namespace chasles::test
