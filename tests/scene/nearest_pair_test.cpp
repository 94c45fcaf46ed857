// The nearest pair of many against all pairs one by one.
#include "chasles/scene/nearest_pair.h"

#include "chasles/base/invalid_input.h"
#include "chasles/base/limit.h"
#include "tests/query/bodies.h"
#include "tests/support/random_poses.h"

#include <gtest/gtest.h>
#include <limits>
#include <numeric>

namespace chasles::test {
namespace {

using scene::nearest_pair;
using scene::NearestPairQuery;

/// Half of the bodies stand still. Few stand so close that they touch.
Scene random_world(Random& random, int count, double size) {
    std::mt19937 shapes_random(unsigned(random.integer(0, 1 << 30)));
    Scene world;
    for (int i = 0; i < count; ++i) {
        const Pose start = random_pose(random, size), goal = random_pose(random, size);
        const Motion motion = i % 2 == 0 ? Motion::at_rest(start) : Motion::velocity(start, goal);
        world.add({std::to_string(i), random_octahedron(shapes_random).polyhedron(), motion, ""});
    }
    return world;
}

LeastDistance of_pair(const Scene& world, std::size_t a, std::size_t b) {
    const SceneBody &moving = world.bodies()[a], &fixed = world.bodies()[b];
    return least_distance({moving.shape, fixed.shape, relative(moving.motion, fixed.motion)});
}

std::vector<std::size_t> all_of(std::size_t begin, std::size_t end) {
    std::vector<std::size_t> indices(end - begin);
    std::iota(indices.begin(), indices.end(), begin);
    return indices;
}

TEST(NearestPair, IsThatOfAllPairs) {
    Random random(4101);
    int apart = 0;
    for (int trial = 0; trial < 120; ++trial) {
        SCOPED_TRACE(trial);
        const auto count = std::size_t(random.integer(2, 9));
        const std::size_t middle = count / 2;
        Scene world = random_world(random, int(count), trial % 3 == 0 ? 3 : 12);
        world.ignore("0", "1");
        for (const bool is_within : {true, false}) {
            double expected = std::numeric_limits<double>::infinity();
            for (std::size_t a = 0; a < count; ++a)
                for (std::size_t b = a + 1; b < count; ++b)
                    if ((is_within || (a < middle && b >= middle)) && !world.is_ignored(a, b))
                        expected = std::min(expected, of_pair(world, a, b).distance.upper);
            NearestPairQuery query{.pairs = {.first = all_of(0, is_within ? count : middle)}};
            if (!is_within)
                query.pairs.second = all_of(middle, count);
            const SceneDistance found = nearest_pair(world, query);
            ASSERT_EQ(found.pair.has_value(), expected < std::numeric_limits<double>::infinity());
            if (!found.pair)
                continue;
            EXPECT_NEAR(found.nearest.distance.upper, expected, 1e-6 * expected);
            EXPECT_LE(found.nearest.distance.lower, expected);
            EXPECT_GE(found.nearest.distance.lower, expected * (1 - 2e-6));
            EXPECT_EQ(found.nearest.distance.upper,
                      of_pair(world, found.pair->first, found.pair->second).distance.upper);
            apart += expected > 0;
        }
    }
    EXPECT_GT(apart, 60);
    EXPECT_LT(apart, 230);
}

/// Of a scene: without pairs that are ignored, or that never move.
TEST(NearestPair, OfASceneIsThatOfItsTestedPairs) {
    Random random(4105);
    for (int trial = 0; trial < 60; ++trial) {
        SCOPED_TRACE(trial);
        Scene world = random_world(random, random.integer(3, 8), trial % 3 == 0 ? 3 : 12);
        world.ignore("1", "2");
        double expected = std::numeric_limits<double>::infinity();
        for (std::size_t a = 0; a < world.bodies().size(); ++a)
            for (std::size_t b = a + 1; b < world.bodies().size(); ++b)
                if (!world.is_ignored(a, b) && (a % 2 == 1 || b % 2 == 1))
                    expected = std::min(expected, of_pair(world, a, b).distance.upper);
        const SceneDistance found = world.least_distance({.tolerance = 1e-9});
        ASSERT_TRUE(found.pair);
        EXPECT_TRUE(found.nearest.certain);
        EXPECT_LE(found.nearest.distance.lower, expected);
        EXPECT_NEAR(found.nearest.distance.upper, expected, 1e-6 * expected);
        const auto [moving, fixed] = *found.pair;
        EXPECT_TRUE(moving % 2 == 1) << "what stands still is the fixed one";
        EXPECT_EQ(found.untested.count(UntestedReason::ignored), 1U);
        EXPECT_NE(std::minmax(moving, fixed), std::minmax(std::size_t(1), std::size_t(2)));
    }
}

/// The tree and the bounds leave few pairs of a thousand bodies.
TEST(NearestPair, ComparesFewPairs) {
    Random random(4102);
    std::mt19937 shapes_random(7);
    Scene world;
    const Polyhedron shape = random_octahedron(shapes_random).polyhedron();
    for (int i = 0; i < 1000; ++i) {
        Pose pose = random_pose(random, 0.1);
        pose.translation += 8 * Eigen::Vector3d(i % 10, i / 10 % 10, i / 100);
        world.add({std::to_string(i), shape, Motion::at_rest(pose), ""});
    }
    const SceneDistance found = nearest_pair(world, {.pairs = {.first = all_of(0, 1000)}});
    ASSERT_TRUE(found.pair);
    EXPECT_GT(found.nearest.distance.lower, 0);
    EXPECT_LT(found.pairs, 4000U); // of 499,500
}

TEST(NearestPair, OfNoPairIsNone) {
    Random random(4103);
    const Scene world = random_world(random, 3, 5);
    EXPECT_FALSE(nearest_pair(world, {.pairs = {.first = {}}}).pair);
    EXPECT_FALSE(nearest_pair(world, {.pairs = {.first = {1}}}).pair);
    EXPECT_FALSE(nearest_pair(world, {.pairs = {.first = {1}, .second = std::vector<std::size_t>()}}).pair);
    EXPECT_FALSE(nearest_pair(world, {.pairs = {.first = {1}, .second = std::vector<std::size_t>{1}}}).pair);
}

TEST(NearestPair, IsCancelledAndRefusesWhatItCannotUse) {
    Random random(4104);
    const Scene world = random_world(random, 4, 5);
    {
        const Limit no_time(1e-9);
        const SceneDistance found = world.least_distance();
        EXPECT_FALSE(found.nearest.certain);
        EXPECT_EQ(found.nearest.distance.upper, std::numeric_limits<double>::infinity());
        EXPECT_LE(found.nearest.distance.lower, of_pair(world, 0, 1).distance.upper);
    }
    EXPECT_THROW(static_cast<void>(nearest_pair(world, {.pairs = {.first = {4}}})), InvalidInput);
    EXPECT_THROW(static_cast<void>(nearest_pair(world, {.pairs = {.first = {0, 1}}, .options = {.tolerance = 2}})),
                 InvalidInput);
}

} // namespace
} // namespace chasles::test
