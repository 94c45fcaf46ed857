// The distance of the nearest pair over time, beside the profiles of all pairs one by one.
#include "chasles/base/limit.h"
#include "chasles/mesh/primitives.h"
#include "chasles/scene/scene.h"
#include "tests/scene/moving_octahedra.h"
#include "tests/support/refusal.h"

#include <gtest/gtest.h>
#include <limits>

namespace chasles::test {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

std::size_t step_of(const DistanceProfile& profile, double time) {
    return std::size_t(std::ranges::upper_bound(profile.times, time) - profile.times.begin()) - 1;
}

TEST(SceneProfile, IsTheLeastOfAllPairs) {
    Random random(4502);
    std::size_t apart = 0, changes = 0;
    for (int trial = 0; trial < 60; ++trial) {
        SCOPED_TRACE(trial);
        const auto count = std::size_t(random.integer(2, 8));
        Scene world = moving_octahedra(random, int(count), trial % 3 == 0 ? 4 : 12);
        world.ignore("0", "1");
        const ProfileOptions options{.tolerance = 0.02, .absolute_tolerance = 1e-4};
        const SceneProfile found = world.profile(options);
        std::vector<DistanceProfile> pairs;
        for (std::size_t a = 0; a < count; ++a)
            for (std::size_t b = a + 1; b < count; ++b)
                if (!world.is_ignored(a, b) && !(world.rests(a) && world.rests(b)))
                    pairs.push_back(profile({world.bodies()[a].shape, world.bodies()[b].shape,
                                             relative(world.bodies()[a].motion, world.bodies()[b].motion), options}));
        if (pairs.empty()) {
            EXPECT_EQ(found.distance.lower.front(), infinity);
            EXPECT_TRUE(found.pairs.empty());
            continue;
        }
        EXPECT_TRUE(found.distance.certain);
        ASSERT_EQ(found.distance.nearest.size() + 1, found.distance.times.size());
        changes += found.pairs.size() > 1;
        for (int i = 0; i < 200; ++i) {
            const double time = (i + 0.5) / 200;
            double lower = infinity, upper = infinity;
            for (const DistanceProfile& pair : pairs) {
                lower = std::min(lower, pair.lower[step_of(pair, time)]);
                upper = std::min(upper, pair.upper[step_of(pair, time)]);
            }
            const std::size_t step = step_of(found.distance, time);
            const double below = found.distance.lower[step], above = found.distance.upper[step];
            EXPECT_LE(below, upper);
            EXPECT_GE(above, lower);
            apart += below > 0;
            if (below > 0) {
                EXPECT_LE(above - below, std::max(options.tolerance * above, options.absolute_tolerance) + 1e-12);
            }
            const auto [moving, fixed] = found.pairs[found.distance.nearest[step]];
            const Pose a = world.bodies()[moving].motion.pose_at(time), b = world.bodies()[fixed].motion.pose_at(time);
            const Motion at_rest = Motion::at_rest(Pose(b.isometry().inverse() * a.isometry()));
            const LeastDistance named =
                least_distance({world.bodies()[moving].shape, world.bodies()[fixed].shape, at_rest});
            EXPECT_LE(named.distance.lower, above + 1e-12);
        }
    }
    EXPECT_GT(apart, 5000U);
    EXPECT_GT(changes, 20U);
}

/// A ball between two walls: the nearer wall changes in the middle.
TEST(SceneProfile, NamesThePairThatIsNearest) {
    Scene world;
    world.add({"left", box({0.1, 5, 5}).polyhedron(), Motion::at_rest(shifted(-4.1, 0, 0))});
    world.add({"right", box({0.1, 5, 5}).polyhedron(), Motion::at_rest(shifted(4.1, 0, 0))});
    world.add({"ball", make_sphere(1), Motion::velocity(shifted(-2, 0, 0), shifted(2, 0, 0))});
    const SceneProfile found = world.profile({.margins = {2}});
    ASSERT_EQ(found.pairs.size(), 2U);
    EXPECT_EQ(found.pairs[0], (std::pair<std::size_t, std::size_t>{2, 0}));
    EXPECT_EQ(found.pairs[1], (std::pair<std::size_t, std::size_t>{2, 1}));
    EXPECT_EQ(found.distance.nearest.front(), 0U);
    EXPECT_EQ(found.distance.nearest.back(), 1U);
    EXPECT_EQ(found.untested.count(UntestedReason::at_rest), 1U);
    for (int i = 0; i < 100; ++i) {
        const double time = (i + 0.5) / 100, distance = 1 + std::min(4 * time, 4 - 4 * time);
        const std::size_t step = step_of(found.distance, time);
        EXPECT_LE(found.distance.lower[step], distance + 1e-12);
        EXPECT_GE(found.distance.upper[step], distance - 1e-12);
    }
    const Zones zones = found.distance.zones(2);
    ASSERT_EQ(zones.inside.size(), 2U);
    EXPECT_NEAR(zones.inside[0].upper, 0.25, 1e-5);
    EXPECT_NEAR(zones.inside[1].lower, 0.75, 1e-5);
}

/// All gaps are below the absolute tolerance.
TEST(SceneProfile, IsFreeWhileNoPairTouches) {
    const Polyhedron cube = make_box({1, 1, 1});
    const auto at = [](double x, double z) { return Pose({x, 0, z}, Eigen::Quaterniond::Identity()); };
    Scene drawers;
    drawers.add({"below", cube, Motion::at_rest(at(0, 0))});
    drawers.add({"drawer", cube, Motion::velocity(at(-0.2, 1 + 1e-7), at(0.2, 1 + 1e-7))});
    drawers.add({"above", cube, Motion::at_rest(at(0, 2 + 3e-7))});
    const std::vector<Bracket> free = drawers.profile().distance.free();
    ASSERT_EQ(free.size(), 1U);
    EXPECT_EQ(free[0].lower, 0);
    EXPECT_EQ(free[0].upper, 1);
    drawers.add({"stop", cube, Motion::velocity(at(9, 0), at(-7, 0))}); // through "below" from 0.5 to 0.625
    const std::vector<Bracket> beside = drawers.profile().distance.free();
    ASSERT_EQ(beside.size(), 2U);
    EXPECT_LE(beside[0].upper, 0.5);
    EXPECT_NEAR(beside[0].upper, 0.5, 1e-6);
    EXPECT_GE(beside[1].lower, 0.625);
    EXPECT_NEAR(beside[1].lower, 0.625, 1. / 128);
    EXPECT_EQ(beside[1].upper, 1);
}

TEST(SceneProfile, EndsAtALimitWithWhatIsProven) {
    Random random(4503);
    const Scene world = moving_octahedra(random, 30, 8);
    const DistanceProfile whole = world.profile().distance;
    const Limit limit(1e-9);
    const SceneProfile found = world.profile();
    EXPECT_FALSE(found.distance.certain);
    EXPECT_EQ(found.distance.lower.front(), 0);
    for (int i = 0; i < 50; ++i) {
        const double time = (i + 0.5) / 50;
        EXPECT_GE(found.distance.upper[step_of(found.distance, time)], whole.lower[step_of(whole, time)]);
    }
}

TEST(SceneProfile, RefusesOptionsByName) {
    EXPECT_EQ(refusal([] { (void)Scene().profile({.tolerance = 2}); }), "query: tolerance: must be in [1e-4, 1]");
}

} // namespace
} // namespace chasles::test
