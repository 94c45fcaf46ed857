// The plane never separates bodies that touch, and it separates most convex bodies that nearly touch.
#include "chasles/culling/plane_between.h"

#include "chasles/motion/any_trajectory.h"
#include "chasles/motion/motion.h"
#include "tests/query/bodies.h"
#include "tests/support/random.h"
#include "tests/support/random_poses.h"

#include <gtest/gtest.h>

namespace chasles::culling {
namespace {

using Eigen::Vector3d;
using test::Random;
using test::random_point;
using test::random_pose;

/// Empty without a coarse motion.
std::optional<bool> is_plane_between(const Polyhedron& moving, const Polyhedron& fixed, const Motion& motion,
                                     double margin) {
    const auto coarse = motion.trajectory().coarse(0);
    if (!coarse)
        return std::nullopt;
    const CoarseScene scene{moving.body(), fixed.body(), *coarse, margin};
    return have_plane_between(scene, scene.placement(0), scene.placement(1));
}

/// A convex body and a motion, both random, and a second body that touches it at one time on the way.
struct Touch {
    test::Body moving;
    Motion motion;
    test::Body fixed;
    Vector3d normal; ///< from the moving body to the fixed body

    Touch(Random& random, double angle, double travel)
        : moving(random_box(random)), motion(random_motion(random, angle, travel)), fixed(random_box(random)),
          normal(random_point(random, 1).normalized()) {
        const Eigen::Isometry3d there = motion.pose_at(random.uniform(0, 1)).isometry();
        const auto along = [&](const Vector3d& a, const Vector3d& b) { return normal.dot(a) < normal.dot(b); };
        std::vector<Vector3d> placed;
        for (const Vector3d& vertex : moving.vertices)
            placed.emplace_back(there * vertex);
        const Vector3d highest = *std::ranges::max_element(placed, along);
        const Vector3d lowest = *std::ranges::min_element(fixed.vertices, along);
        for (Vector3d& vertex : fixed.vertices)
            vertex += highest - lowest;
    }

    static test::Body random_box(Random& random) {
        const auto half = [&] { return 0.1 * std::pow(10, random.uniform(0, 1)); };
        return test::box({half(), half(), half()});
    }
    static Motion random_motion(Random& random, double angle, double travel) {
        const Pose start(random_point(random, 0.3), Eigen::Quaterniond(random_pose(random, 1).rotation));
        const Eigen::Quaterniond turn(Eigen::AngleAxisd(angle, random_point(random, 1).normalized()));
        const Pose goal(start.translation + travel * random_point(random, 1), turn * start.rotation);
        switch (random.integer(0, 2)) {
        case 0:
            return Motion::sweep(start, goal, random_point(random, 1));
        case 1:
            return Motion::screw(start, goal);
        default:
            return Motion::velocity(start, goal, random_point(random, 1));
        }
    }
    /// With the fixed body moved away from the contact.
    [[nodiscard]] std::optional<bool> is_separated(double distance, double margin = 0) const {
        test::Body away = fixed;
        for (Vector3d& vertex : away.vertices)
            vertex += distance * normal;
        return is_plane_between(moving.polyhedron(), away.polyhedron(), motion, margin);
    }
};

TEST(PlaneBetween, NeverWhereBodiesTouch) {
    Random random(2501);
    int separated = 0, asked = 0;
    for (int trial = 0; trial < 20000; ++trial) {
        const Touch touch(random, random.uniform(0, 0.7), random.chance(0.5) ? 0.05 : 1);
        ASSERT_FALSE(touch.is_separated(0).value_or(false)) << trial;
        ASSERT_FALSE(touch.is_separated(0.3 * (1 - 1e-6), 0.3).value_or(false)) << trial;
        const auto found = touch.is_separated(0.3);
        asked += found.has_value();
        separated += found.value_or(false);
    }
    EXPECT_GT(separated, asked / 4);
}

/// Only roundings to single precision could separate them.
TEST(PlaneBetween, NeverWhereABoxSlidesAlongAnother) {
    Random random(2504);
    for (int trial = 0; trial < 1000; ++trial) {
        const double a = random.uniform(0.2, 1), b = random.uniform(0.2, 1);
        const Motion motion = Motion::sweep(Pose({a + b, -0.1, 0}, Eigen::Quaterniond::Identity()),
                                            Pose({a + b, 0.1, 0}, Eigen::Quaterniond::Identity()), Vector3d::Zero());
        const Polyhedron moving = test::box({a, 1, 1}).polyhedron(), fixed = test::box({b, 1, 1}).polyhedron();
        ASSERT_EQ(is_plane_between(moving, fixed, motion, 0), false) << trial;
    }
}

/// What the plane needs is the chord deviation, and little more.
TEST(PlaneBetween, WhereBodiesNearlyTouch) {
    Random random(2502);
    int separated = 0, asked = 0;
    for (int trial = 0; trial < 1000; ++trial) {
        const auto found = Touch(random, 0.05, 0.005).is_separated(0.02);
        asked += found.has_value();
        separated += found.value_or(false);
    }
    EXPECT_GT(separated, 0.9 * asked);
}

/// True places may be off the coarse motion by so much.
TEST(PlaneBetween, CountsTheDeviationOfTheCoarseMotion) {
    const Polyhedron cube = test::box({0.5, 0.5, 0.5}).polyhedron();
    const Motion motion = Motion::sweep(Pose({1.04, -0.05, 0}, Eigen::Quaterniond::Identity()),
                                        Pose({1.04, 0.05, 0}, Eigen::Quaterniond::Identity()), Vector3d::Zero());
    const auto is_separated = [&](double deviation, double turn_deviation) {
        motion::CoarseMotion coarse = motion.trajectory().coarse(0).value();
        coarse.deviation = deviation;
        coarse.turn_deviation = turn_deviation;
        const CoarseScene scene{cube.body(), cube.body(), coarse, 0};
        return have_plane_between(scene, scene.placement(0), scene.placement(1));
    };
    EXPECT_TRUE(is_separated(0, 0));
    EXPECT_TRUE(is_separated(0.039, 0));
    EXPECT_FALSE(is_separated(0.041, 0));
    EXPECT_FALSE(is_separated(0, 0.05)); // its corners are 0.87 from the centre
}

/// Its hull contains the other body.
TEST(PlaneBetween, NeverInACage) {
    test::Body cage = test::box({0.1, 1, 1});
    test::add_box(cage, {2, 0, 0}, {0.1, 1, 1});
    const Polyhedron cube = test::box({0.2, 0.2, 0.2}).polyhedron();
    const Motion rest = Motion::sweep(Pose({1, 0, 0}, Eigen::Quaterniond::Identity()),
                                      Pose({1, 0.01, 0}, Eigen::Quaterniond::Identity()), Vector3d::Zero());
    EXPECT_EQ(is_plane_between(cube, cage.polyhedron(), rest, 0), false);
    EXPECT_EQ(is_plane_between(cube, test::box({0.1, 1, 1}).polyhedron(), rest, 0), true);
    EXPECT_EQ(is_plane_between(cube, cube, Motion::sweep(Pose(), Pose(), Vector3d::Zero()), 0), false); // no direction
}

} // namespace
} // namespace chasles::culling
