// When bodies are free is decided by touch, which is exact, and not by the absolute tolerance of the curve.
#include "chasles/query/profile.h"

#include "chasles/motion/timed_poses.h"
#include "tests/query/bodies.h"

#include <gtest/gtest.h>

namespace chasles::test {
namespace {

DistanceProfile of_cubes(const Motion& motion, const ProfileOptions& options = {}) {
    const Polyhedron cube = box({0.5, 0.5, 0.5}).polyhedron();
    return profile({.moving = cube, .fixed = cube, .motion = motion, .options = options});
}

void expect_free(const DistanceProfile& found, const std::vector<Bracket>& expected, double error) {
    const std::vector<Bracket> free = found.free();
    ASSERT_EQ(free.size(), expected.size());
    for (std::size_t i = 0; i < free.size(); ++i) {
        EXPECT_GE(free[i].lower, expected[i].lower);
        EXPECT_LE(free[i].lower, expected[i].lower + error);
        EXPECT_LE(free[i].upper, expected[i].upper);
        EXPECT_GE(free[i].upper, expected[i].upper - error);
    }
    EXPECT_TRUE(found.certain);
    for (std::size_t i = 0; i < found.times.size(); ++i)
        EXPECT_LE(found.lower[i], found.upper[i]);
}

TEST(ProfileFree, ASmallGapIsFree) {
    for (const double gap : {1e-6, 1e-9}) {
        const Pose start = shifted(0.3, 0.2, 1 + gap);
        const std::vector<Motion> motions{
            Motion::velocity(start, turned(start.translation, {0, 0, 1}, 0.2)),
            Motion::velocity(shifted(-3, 0, 1 + gap), shifted(3, 0, 1 + gap)),
            TimedPoses::through({0, 0.5, 1}, {start, shifted(0.3, 0.5, 1 + gap), shifted(0.3, -0.5, 1 + gap)})};
        for (const Motion& motion : motions)
            for (const ProfileOptions& options : {ProfileOptions{}, ProfileOptions{.absolute_tolerance = 1e-5}}) {
                const DistanceProfile found = of_cubes(motion, options);
                ASSERT_EQ(found.free().size(), 1U);
                EXPECT_EQ(found.free()[0].lower, 0);
                EXPECT_EQ(found.free()[0].upper, 1);
            }
    }
}

TEST(ProfileFree, BodiesThatTouchAreNot) {
    EXPECT_TRUE(of_cubes(Motion::velocity(shifted(-0.4, 0, 1), shifted(0.4, 0, 1))).free().empty());
    EXPECT_TRUE(of_cubes(Motion::velocity(shifted(-0.4, 0, 0.9), shifted(0.4, 0, 0.9))).free().empty());
}

/// Between, before and after two touches, at a gap below the tolerance.
TEST(ProfileFree, ASmallGapIsFreeBetweenTouches) {
    constexpr double gap = 1e-7;
    const Pose near = shifted(0.3, 0.2, 1 + gap), deep = shifted(0.3, 0.2, 0.5);
    const DistanceProfile twice = of_cubes(TimedPoses::through({0, 0.25, 0.375, 0.5, 0.75, 0.8125, 0.875, 1},
                                                               {near, near, deep, near, near, deep, near, near}));
    // Beside a touch at most 1/128 of a piece may be missing.
    expect_free(twice, {{0, 0.25 + 1e-7}, {0.5 - 1e-7, 0.75 + 1e-7}, {0.875 - 1e-7, 1}}, 0.125 / 128 + 2e-7);
    EXPECT_LT(twice.times.size(), 3000U);
}

/// A dip through the other body between two times at which both are apart by less than the tolerance. The way is
/// 8 (t - 0.3)^2 (t - 0.7)^2 - depth.
TEST(ProfileFree, DipsThroughTheBodyAreNot) {
    const std::vector<double> square{0.0441, -0.42, 1.42, -2, 1}; // of (t - 0.3) (t - 0.7)
    for (const double depth : {1e-2, 1e-4, 1e-6, 1e-8}) {
        std::vector<Eigen::Vector3d> places;
        for (const double coefficient : square)
            places.emplace_back(0, 0, 8 * coefficient);
        places[0] += Eigen::Vector3d(0.3, 0.2, 1 - depth);
        const auto gap_at = [&](double time) {
            const double both = (time - 0.3) * (time - 0.7);
            return 8 * both * both - depth;
        };
        for (const double tolerance : {1.0, 0.2, 1e-2, 1e-3}) {
            const std::vector<Bracket> free =
                of_cubes(Motion::polynomial(places), {.absolute_tolerance = tolerance}).free();
            EXPECT_GE(free.size(), 2U) << depth << " " << tolerance; // before the first dip, and after the last one
            for (const auto& [begin, end] : free)
                for (int i = 0; i <= 10'000; ++i)
                    ASSERT_GT(gap_at(begin + (end - begin) * i / 10'000), -1e-12) << depth << " " << tolerance;
        }
    }
}

} // namespace
} // namespace chasles::test
