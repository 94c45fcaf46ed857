// What a body sweeps, against its true places; the meeting of balls against its closed form in long double.
#include "chasles/scene/swept_body.h"

#include "chasles/motion/any_trajectory.h"
#include "chasles/motion/timed_poses.h"
#include "tests/query/bodies.h"
#include "tests/support/random_poses.h"

#include <gtest/gtest.h>

namespace chasles::test {
namespace {

using Eigen::Vector3d;

/// Motions that leave the straight way between their ends, about lines near and far.
Motion random_motion(Random& random) {
    const Pose start = random_pose(random, 3);
    const auto goal = [&] { return random_goal(random, start, random.uniform(0, 3), random.uniform(0, 3)); };
    const auto far_point = [&] { return random_point(random, std::abs(random.scaled(-2, 1))); };
    switch (random.integer(0, 5)) {
    case 0:
        return Motion::velocity(start, goal(), far_point());
    case 1:
        return Motion::twist(start, goal());
    case 2:
        return Motion::at_rest(start) * Motion::hinge(far_point(), random_point(random, 1), {0, 3, -4, 2});
    case 3:
        return Motion::polynomial({random_point(random, 2), random_point(random, 6), random_point(random, 6)}) *
               Motion::hinge(far_point(), random_point(random, 1), {0, 3});
    case 4:
        return TimedPoses::through({0, 0.2, 0.7, 1}, {start, goal(), goal(), goal()});
    default:
        return Motion::at_rest(Pose(start.translation * 1e6, start.rotation));
    }
}

/// A body away from the origin of its frame.
Polyhedron random_shape(Random& random) {
    Body body = box(Vector3d(0.1, 0.1, 0.1) + random_point(random, 1).cwiseAbs());
    const Vector3d place = random_point(random, 2);
    for (Vector3d& vertex : body.vertices)
        vertex += place;
    return body.polyhedron();
}

TEST(SweptBody, HoldsTheBodyAllAlong) {
    Random random(2711);
    int finite = 0;
    for (int trial = 0; trial < 2000; ++trial) {
        const Polyhedron shape = random_shape(random);
        const Motion motion = random_motion(random);
        const motion::SharedFrame frame = motion.trajectory().frame();
        const double until = random.chance(0.5) ? 1 : random.uniform(0.1, 1);
        const scene::SweptBody swept = scene::swept({shape.body(), *frame, scene::is_at_rest(*frame)}, until);
        const scene::MovingBall half = scene::rest_of(swept.ball, 0.5);
        finite += std::isfinite(swept.ball.radius) ? 1 : 0;
        for (int k = 0; k <= 64; ++k) {
            const double share = k / 64.0;
            const Eigen::Isometry3d pose = motion.pose_at(share * until).isometry();
            for (const Vector3d& vertex : shape.vertices()) {
                const Vector3d place = pose * vertex;
                ASSERT_TRUE(swept.box.contains(place)) << trial << ", " << share;
                const double most = swept.ball.radius + 1e-12 * swept.ball.size;
                ASSERT_LE((place - swept.ball.start - share * swept.ball.way).norm(), most) << trial << ", " << share;
                if (share >= 0.5) {
                    ASSERT_LE((place - half.start - (2 * share - 1) * half.way).norm(), most) << trial << ", " << share;
                }
            }
        }
    }
    EXPECT_GT(finite, 1000);
}

TEST(SweptBody, StandsStillOnlyIfItNeverMoves) {
    const auto stands_still = [](const Motion& motion) { return scene::is_at_rest(*motion.trajectory().frame()); };
    const Pose away = shifted(1, 0, 0);
    EXPECT_TRUE(stands_still(Motion::at_rest(away)));
    EXPECT_FALSE(stands_still(Motion::velocity(Pose(), away)));
    EXPECT_FALSE(stands_still(Motion::hinge({0, 0, 0}, {0, 0, 1}, {0, 1})));
    EXPECT_FALSE(stands_still(Motion::hinge({0, 0, 0}, {0, 0, 1}, {0, 0, 1})));
    EXPECT_FALSE(stands_still(TimedPoses::through({0, 0.5, 1}, {away, away, Pose()}))) << "it waits, then it moves";
}

TEST(MovingBall, MeetsNoEarlierThanIsTold) {
    Random random(2712);
    int meeting = 0;
    for (int trial = 0; trial < 100'000; ++trial) {
        const auto ball = [&] {
            return scene::MovingBall{random_point(random, 5), random_point(random, 10), random.uniform(0, 1), 0};
        };
        scene::MovingBall a = ball();
        const scene::MovingBall b = ball();
        const double margin = random.chance(0.5) ? 0 : random.uniform(0, 1);
        using Long = Eigen::Matrix<long double, 3, 1>;
        const Long apart = a.start.cast<long double>() - b.start.cast<long double>();
        const Long way = a.way.cast<long double>() - b.way.cast<long double>();
        const long double square = way.squaredNorm(), closing = -apart.dot(way);
        const long double least = (apart + way * (closing / square)).norm(); // of the distances of both centres
        if (random.chance(0.5))                                              // they graze
            a.radius = std::max(0.0, double(least) - b.radius - margin);
        const long double reach = 0.0L + a.radius + b.radius + margin;
        const double found = scene::earliest_meeting(a, b, margin);
        if (apart.norm() <= reach) {
            EXPECT_EQ(found, 0);
            continue;
        }
        if (closing <= 0 || least > reach) {
            if (closing <= 0 || least > reach + 1e-10L) {
                EXPECT_EQ(found, 2);
            }
            continue;
        }
        const long double root = std::sqrt((reach - least) * (reach + least) * square);
        const long double first = (closing - root) / square;
        ASSERT_LE(found, std::min(first, 2.0L)) << trial;
        EXPECT_GE(found, std::min(first, 2.0L) * 0.9999 - 1e-4) << "far too early";
        meeting += first < 1 ? 1 : 0;
    }
    EXPECT_GT(meeting, 10'000);
}

} // namespace
} // namespace chasles::test
