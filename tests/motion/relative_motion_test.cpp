// Two moving bodies: the motion of one in the frame of the other, reported in the world.
#include "chasles/motion/motion.h"
#include "tests/support/random_poses.h"
#include "tests/support/trajectories.h"

#include <gtest/gtest.h>

namespace chasles {
namespace {

using namespace test;

struct TwoBodies {
    Pose moving_start;
    Pose moving_goal;
    Pose fixed_start;
    Pose fixed_goal;

    [[nodiscard]] TwoBodies placed_by(const Eigen::Isometry3d& world) const {
        return {world * moving_start.isometry(), world * moving_goal.isometry(), world * fixed_start.isometry(),
                world * fixed_goal.isometry()};
    }
};

TwoBodies random_bodies(Random& random) {
    const Pose a = random_pose(random, 2);
    const Pose b = random_pose(random, 2);
    return {a, random_goal(random, a, 1.5, 2), b, random_goal(random, b, 0.7, 2)};
}

template <class Motion>
Motion relative(const TwoBodies& bodies) {
    return Motion::relative(bodies.moving_start, bodies.moving_goal, bodies.fixed_start, bodies.fixed_goal);
}

void expect_near(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b) {
    EXPECT_LT((a.matrix() - b.matrix()).cwiseAbs().maxCoeff(), 3e-14);
}

template <class Motion>
void expect_end_poses(const TwoBodies& bodies) {
    const auto motion = relative<Motion>(bodies);
    expect_near(motion.pose_at(0).isometry(), bodies.moving_start.isometry());
    expect_near(motion.pose_at(1).isometry(), bodies.moving_goal.isometry());
    expect_near(motion.trajectory().fixed_pose_at(0).isometry(), bodies.fixed_start.isometry());
    expect_near(motion.trajectory().fixed_pose_at(1).isometry(), bodies.fixed_goal.isometry());
}

TEST(RelativeMotion, EndsWhereBothBodiesEnd) {
    Random random(661);
    for (int trial = 0; trial < 50; ++trial) {
        const TwoBodies bodies = random_bodies(random);
        expect_end_poses<ScrewMotion>(bodies);
        expect_end_poses<SweepMotion>(bodies);
    }
}

/// The pose of the moving body in the frame of the fixed body.
template <class Motion>
Eigen::Isometry3d seen_from_fixed(const Motion& motion, double time) {
    return motion.trajectory().fixed_pose_at(time).isometry().inverse() * motion.pose_at(time).isometry();
}

template <class Motion>
void expect_seen_as_one_motion(const TwoBodies& bodies) {
    const auto motion = relative<Motion>(bodies);
    const Eigen::Isometry3d start = bodies.fixed_start.isometry().inverse() * bodies.moving_start.isometry();
    const Eigen::Isometry3d goal = bodies.fixed_goal.isometry().inverse() * bodies.moving_goal.isometry();
    const auto alone = Motion::between(start, goal);
    EXPECT_NEAR(motion.angle(), alone.angle(), 1e-14);
    for (const double time : {0.0, 0.2, 0.5, 0.9, 1.0})
        expect_near(seen_from_fixed(motion, time), alone.pose_at(time).isometry());
}

TEST(RelativeMotion, IsOneMotionSeenFromTheFixedBody) {
    Random random(662);
    for (int trial = 0; trial < 50; ++trial) {
        const TwoBodies bodies = random_bodies(random);
        expect_seen_as_one_motion<ScrewMotion>(bodies);
        expect_seen_as_one_motion<SweepMotion>(bodies);
    }
}

template <class Motion>
void expect_independent_of_the_world(const TwoBodies& bodies, const Eigen::Isometry3d& world) {
    const auto here = relative<Motion>(bodies);
    const auto there = relative<Motion>(bodies.placed_by(world));
    for (const double time : {0.0, 0.4, 1.0}) {
        expect_near(seen_from_fixed(here, time), seen_from_fixed(there, time));
        expect_near(world * here.pose_at(time).isometry(), there.pose_at(time).isometry());
    }
}

TEST(RelativeMotion, DoesNotDependOnWhereTheWorldsOriginIs) {
    Random random(663);
    for (int trial = 0; trial < 50; ++trial) {
        const TwoBodies bodies = random_bodies(random);
        const Eigen::Isometry3d world = random_pose(random, 3).isometry();
        expect_independent_of_the_world<ScrewMotion>(bodies, world);
        expect_independent_of_the_world<SweepMotion>(bodies, world);
    }
}

TEST(RelativeMotion, OfAFixedBodyAtRestIsTheMotionItself) {
    Random random(664);
    const Pose start = random_pose(random, 2);
    const Pose goal = random_goal(random, start, 1, 2);
    const auto alone = ScrewMotion::between(start, goal);
    const auto beside = ScrewMotion::relative(start, goal, Pose(), Pose());
    EXPECT_EQ(beside.angle(), alone.angle());
    EXPECT_EQ(beside.slide(), alone.slide());
    for (const double time : {0.0, 0.3, 1.0})
        expect_near(beside.pose_at(time).isometry(), alone.pose_at(time).isometry());
}

} // namespace
} // namespace chasles
