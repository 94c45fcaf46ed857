// Motions back: their poses, the bounds of their rates, and last contacts against closed forms.
#include "chasles/mesh/primitives.h"
#include "chasles/motion/any_trajectory.h"
#include "chasles/motion/motion.h"
#include "chasles/motion/timed_poses.h"
#include "chasles/query/first_contact.h"
#include "tests/motion/frame_bounds.h"
#include "tests/support/random_poses.h"
#include "tests/support/refusal.h"

#include <gtest/gtest.h>
#include <numbers>

namespace chasles::test {
namespace {

using Eigen::Vector3d;

constexpr int kinds = 12;

Motion motion_of_kind(Random& random, int kind) {
    const Pose start = random_pose(random, 2), goal = random_pose(random, 2), third = random_pose(random, 2);
    const Motion hinge = Motion::hinge(random_point(random, 2), random_point(random, 1), {0.3, -2, 1.5});
    switch (kind) {
    case 0:
        return SweepMotion::between(start, goal, random_point(random, 1));
    case 1:
        return SweepMotion::relative(start, goal, third, random_pose(random, 2));
    case 2:
        return Motion::velocity(start, goal, random_point(random, 1));
    case 3:
        return Motion::twist(start, goal);
    case 4:
        return Motion::velocity(start, Pose(goal.translation, start.rotation));
    case 5:
        return Motion::at_rest(start);
    case 6:
        return hinge;
    case 7:
        return Motion::slider(random_point(random, 1), {0.1, 2, -1}) * hinge;
    case 8:
        return relative(hinge, Motion::twist(start, goal));
    case 9:
        return relative(Motion::velocity(start, Pose(goal.translation, start.rotation)), Motion::at_rest(third));
    case 10:
        return TimedPoses::through({0, 1, 5}, {start, goal, third});
    default:
        return Motion::spline({0, 0.3, 1}, {start, goal, third});
    }
}

TEST(Reversed, HasThePosesOfTheMotionFromItsEnd) {
    Random random(4501);
    for (int trial = 0; trial < 10 * kinds; ++trial) {
        SCOPED_TRACE(trial % kinds);
        const Motion motion = motion_of_kind(random, trial % kinds), back = motion.reversed();
        for (const double time : {0.0, 0.13, 0.5, 0.77, 1.0}) {
            const auto is_same = [](const Pose& a, const Pose& b) {
                return (a.isometry().matrix() - b.isometry().matrix()).norm() < 1e-13;
            };
            EXPECT_TRUE(is_same(back.pose_at(time), motion.pose_at(1 - time))) << time;
            EXPECT_TRUE(is_same(back.fixed_pose_at(time), motion.fixed_pose_at(1 - time))) << time;
            EXPECT_TRUE(is_same(back.reversed().pose_at(time), motion.pose_at(time))) << time;
        }
    }
}

/// The paper's screw slides by tan(t angle / 2).
TEST(Reversed, AScrewHasNoWayBack) {
    const Motion screw = Motion::screw(Pose(), Pose({0, 0, 1}, Eigen::Quaterniond(1, 0, 0, 1)));
    EXPECT_EQ(refusal([&] { (void)screw.reversed(); }),
              "motion: reversed: takes no screw, which slides unevenly, so that the way back is another motion; the "
              "constant twist between the same poses has one");
}

/// Alone, and carried by another motion, where rates add up with their directions.
TEST(Reversed, BoundsOfRatesHold) {
    Random random(4502);
    for (int trial = 0; trial < 3 * kinds; ++trial) {
        SCOPED_TRACE(trial % kinds);
        const Motion back = motion_of_kind(random, trial % kinds).reversed();
        if (!back.trajectory().frame())
            continue;
        expect_bounds_hold(back.trajectory().frame(), std::uint64_t(trial));
        const Motion carrier = Motion::slider(random_point(random, 1), {0, 3, 1}) *
                               Motion::hinge(random_point(random, 1), random_point(random, 1), {0, 2, 0.5});
        expect_bounds_hold((carrier * back).trajectory().frame(), std::uint64_t(trial));
    }
}

/// A cube runs through a post, faster and faster. It touches while |x| <= 1.
TEST(Reversed, TheLastContactIsTheFirstOneOfTheMotionBack) {
    const Polyhedron cube = make_box({1, 1, 1});
    const Motion way = Motion::polynomial({{-3, 0.1, 0.2}, {4, 0, 0}, {3, 0, 0}});
    const double first = (-4 + std::sqrt(40)) / 6, last = (-4 + std::sqrt(64)) / 6;
    const FirstContact forwards = first_contact({cube, cube, way}),
                       backwards = first_contact({cube, cube, way.reversed()});
    EXPECT_LE(forwards.time.lower, first);
    EXPECT_GE(forwards.time.upper, first);
    EXPECT_LE(1 - backwards.time.upper, last);
    EXPECT_GE(1 - backwards.time.lower, last);
    EXPECT_LT(backwards.time.upper - backwards.time.lower, 1e-9);
    EXPECT_TRUE(forwards.certain && backwards.certain);
}

/// A bar on a hinge turns by half a turn, over a post that its side leaves where it met it from the other side.
TEST(Reversed, AHingeLeavesWhereTheClosedFormSays) {
    const Polyhedron bar = make_box({8, 0.5, 2}), post = make_box({0.5, 4, 1});
    const Motion hinge = Motion::at_rest(Pose(Vector3d(0, -4, 0), Eigen::Quaterniond::Identity())) *
                         Motion::hinge({0, 0, 0}, {0, 0, 1}, {0, std::numbers::pi});
    // The corner (0.25, 2) of the post comes to the side y = 0.25 of the bar.
    const double met = std::atan2(2, 0.25) - std::asin(0.25 / std::hypot(2, 0.25));
    for (const Motion& motion : {hinge, hinge.reversed()}) {
        const FirstContact found = first_contact({bar, post, motion});
        EXPECT_NEAR(found.time.lower * std::numbers::pi, met, 1e-12);
        EXPECT_TRUE(found.certain);
    }
}

} // namespace
} // namespace chasles::test
