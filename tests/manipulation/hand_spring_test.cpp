// The spring of a hand: its wish is the gradient of its energy, and displacements are what they say.
#include "chasles/manipulation/hand_spring.h"

#include "tests/query/bodies.h"
#include "tests/support/random_poses.h"

#include <gtest/gtest.h>

namespace chasles::test {
namespace {

using Eigen::Vector3d;
using manipulation::displaced;
using manipulation::HandSpring;
using manipulation::Twist;

Twist random_twist(Random& random, double size) {
    Twist twist;
    twist << random_point(random, size), random_point(random, size);
    return twist;
}

TEST(HandSpring, TheWishIsTheSteepestDescentOfTheEnergy) {
    Random random(1);
    for (int round = 0; round < 1000; ++round) {
        const Eigen::Matrix3d axes =
            Eigen::Quaterniond(random_pose(random, 1).rotation).normalized().toRotationMatrix();
        const Eigen::Matrix3d inertia = axes * Vector3d(0.2, 1, 3).asDiagonal() * axes.transpose();
        const HandSpring spring({random_point(random, 1), inertia});
        const Pose pose = random_pose(random, 2), goal = random_goal(random, pose, random.uniform(0, 3), 2);
        const Twist step = random_twist(random, 1e-5);
        const double work = spring.wish(pose, goal).dot(spring.metric(pose) * step);
        const double lost = spring.energy_lost(pose, displaced(pose, spring.centre(), step), goal);
        EXPECT_NEAR(lost, work, 1e-8) << round; // 1e-5 squared, times curvatures of up to some ten
    }
}

TEST(HandSpring, TheWishLeadsToTheGoalWhereAllMomentsAreEqual) {
    Random random(2);
    for (int round = 0; round < 1000; ++round) {
        const HandSpring spring({random_point(random, 1), 0.7 * Eigen::Matrix3d::Identity()});
        const Pose pose = random_pose(random, 2), goal = random_goal(random, pose, random.uniform(0, 3.1), 2);
        const Pose reached = displaced(pose, spring.centre(), spring.wish(pose, goal));
        EXPECT_LE((reached.isometry().matrix() - goal.isometry().matrix()).norm(), 1e-12) << round;
        const double angle = Eigen::Quaterniond(pose.rotation)
                                 .normalized()
                                 .angularDistance(Eigen::Quaterniond(goal.rotation).normalized());
        const Vector3d way = goal.isometry() * spring.centre() - pose.isometry() * spring.centre();
        EXPECT_NEAR(spring.energy_lost(pose, goal, goal), (way.squaredNorm() + 0.7 * angle * angle) / 2, 1e-12);
    }
}

TEST(HandSpring, TheDefaultMassIsThatOfTheBox) {
    const Polyhedron shape = box({3, 2, 1}).polyhedron();
    const MassProperties mass = manipulation::mass_of_box(shape.body());
    EXPECT_EQ(mass.centre, Vector3d::Zero());
    EXPECT_LE((mass.inertia - Eigen::Matrix3d(Vector3d(4 + 1, 9 + 1, 9 + 4).asDiagonal()) / 3).norm(), 1e-14);
    // a needle resists to be turned about itself as well
    EXPECT_NEAR(manipulation::mass_of_box(box({5, 1e-9, 1e-9}).polyhedron().body()).inertia(0, 0), 1, 1e-12);
}

} // namespace
} // namespace chasles::test
