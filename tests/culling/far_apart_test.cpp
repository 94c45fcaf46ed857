// The bounding spheres separate only bodies that stay apart, and they separate bodies that are clearly apart.
#include "chasles/culling/far_apart.h"

#include "chasles/motion/motion.h"
#include "tests/query/bodies.h"
#include "tests/support/random_poses.h"
#include "tests/support/trajectories.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

namespace chasles::culling {
namespace {

using namespace test;

/// Each cube is centred at the origin of its frame.
TEST(FarApart, NeverWhereBallsMeetOnTheWay) {
    Random random(771);
    const Polyhedron body = box({1, 1, 1}).polyhedron();
    int separated = 0, open = 0;
    for (int trial = 0; trial < 3000; ++trial) {
        const Pose start = random_pose(random, 12);
        const Pose goal = random_pose(random, 12);
        const ScrewMotion screw = ScrewMotion::between(start, goal);
        const SweepMotion sweep = SweepMotion::between(start, goal, random_point(random, 3));
        for (const bool sweeps : {false, true}) {
            const Motion motion = sweeps ? Motion(sweep) : Motion(screw);
            const bool far_apart = are_far_apart(body.body(), body.body(), motion.trajectory());
            (far_apart ? separated : open) += 1;
            if (!far_apart)
                continue;
            for (int i = 0; i <= 64; ++i) {
                const double time = i / 64.0;
                EXPECT_GT((sweeps ? sweep.pose_at(time) : screw.pose_at(time)).translation.norm(), 2 * std::sqrt(3.0));
            }
        }
    }
    std::cout << separated << " separated, " << open << " left open\n";
    EXPECT_GT(separated, 300);
    EXPECT_GT(open, 300);
}

/// Both bodies move, far from the origin of the world.
TEST(FarApart, NeverWhereBallsMeetWhileBothMove) {
    Random random(772);
    const Polyhedron body = box({1, 1, 1}).polyhedron();
    int separated = 0, open = 0;
    for (int trial = 0; trial < 2000; ++trial) {
        const Eigen::Vector3d world = random_point(random, 100);
        const auto pose = [&](double size) {
            const Pose near = random_pose(random, size);
            return Pose(near.translation + world, Eigen::Quaterniond(near.rotation));
        };
        const ScrewMotion screw = ScrewMotion::relative(pose(12), pose(12), pose(3), pose(3));
        const bool far_apart = are_far_apart(body.body(), body.body(), Motion(screw).trajectory());
        (far_apart ? separated : open) += 1;
        for (int i = 0; far_apart && i <= 64; ++i) {
            const double time = i / 64.0;
            const Eigen::Vector3d between =
                screw.pose_at(time).translation - screw.trajectory().fixed_pose_at(time).translation;
            EXPECT_GT(between.norm(), 2 * std::sqrt(3.0));
        }
    }
    std::cout << separated << " separated, " << open << " left open\n";
    EXPECT_GT(separated, 100);
    EXPECT_GT(open, 300);
}

TEST(FarApart, ToldWithoutLookingAtBoxes) {
    const Polyhedron body = box({1, 1, 1}).polyhedron();
    const Pose start(Eigen::Vector3d(100, 0, 0), Eigen::Quaterniond::Identity());
    const Pose goal(Eigen::Vector3d(100, 20, 5), Eigen::Quaterniond(0, 1, 0, 0));
    const ScrewMotion motion = ScrewMotion::between(start, goal);
    const FirstContact found = first_contact({.moving = body, .fixed = body, .motion = motion});
    EXPECT_EQ(found.verdict, Verdict::clear);
    EXPECT_TRUE(found.certain);
    EXPECT_EQ(found.work.node_pairs, 0U);
    EXPECT_TRUE(found.pose.translation.isApprox(goal.translation));
}

TEST(FarApart, NotToldOfBodiesThatTouchAtTheFarEndOfTheWay) {
    const Polyhedron body = box({1, 1, 1}).polyhedron();
    const ScrewMotion motion = ScrewMotion::between(Pose(Eigen::Vector3d(100, 0, 0), Eigen::Quaterniond::Identity()),
                                                    Pose(Eigen::Vector3d(2, 0, 0), Eigen::Quaterniond::Identity()));
    EXPECT_FALSE(are_far_apart(body.body(), body.body(), Motion(motion).trajectory()));
    EXPECT_FALSE(
        are_far_apart(body.body(), body.body(), Motion::screw(motion.pose_at(1), motion.pose_at(0)).trajectory()));
}

/// The body's centre ends at its start and is ten units away at half time.
TEST(FarApart, NotToldOfASweepThatSwingsOut) {
    const Polyhedron moving = box({1, 1, 1}).polyhedron();
    test::Body away = box({1, 1, 1});
    for (Eigen::Vector3d& vertex : away.vertices)
        vertex += Eigen::Vector3d(10, 10, 0);
    const Polyhedron fixed = away.polyhedron();
    const Eigen::Vector3d centre(-10, 0, 0);
    const Pose start = shifted(10, 0, 0);
    const Eigen::Quaterniond turn(Eigen::AngleAxisd(3.1, Eigen::Vector3d::UnitZ()));
    const Pose goal(Eigen::Vector3d(20, 0, 0) - turn * centre, turn);
    const SweepMotion motion = SweepMotion::between(start, goal, centre);
    EXPECT_FALSE(are_far_apart(moving.body(), fixed.body(), Motion(motion).trajectory()));
    EXPECT_EQ(first_contact({.moving = moving, .fixed = fixed, .motion = motion}).verdict, Verdict::contact);
}

TEST(FarApart, NotToldOfBodiesThatMeetFarFromTheWorldsOrigin) {
    const Polyhedron body = box({1, 1, 1}).polyhedron();
    const ScrewMotion motion =
        ScrewMotion::relative(shifted(50, 5, 0), shifted(50, -5, 0), shifted(50, 0, 0), shifted(50, 0, 0));
    EXPECT_FALSE(are_far_apart(body.body(), body.body(), Motion(motion).trajectory()));
}

} // namespace
} // namespace chasles::culling
