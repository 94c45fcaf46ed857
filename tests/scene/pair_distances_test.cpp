// The least distances of all pairs of a scene against each pair alone, and spheres in closed form.
#include "chasles/base/invalid_input.h"
#include "chasles/base/limit.h"
#include "chasles/mesh/primitives.h"
#include "chasles/motion/own_trajectory.h"
#include "chasles/scene/scene.h"
#include "tests/scene/moving_octahedra.h"
#include "tests/support/grid.h"

#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>
#include <gtest/gtest.h>
#include <set>
#include <thread>

namespace chasles::test {
namespace {

using Eigen::Vector3d;

LeastDistance alone(const Scene& world, const PairDistance& pair, const LeastDistanceOptions& options = {}) {
    const SceneBody &moving = world.bodies()[pair.moving], &fixed = world.bodies()[pair.fixed];
    return least_distance({moving.shape, fixed.shape, relative(moving.motion, fixed.motion), options});
}

/// All bits of the numbers.
void expect_same(const LeastDistance& a, const LeastDistance& b) {
    const auto bits = [](const LeastDistance& found) {
        std::vector<std::uint64_t> all;
        for (const double number : {found.distance.lower, found.distance.upper, found.time.lower, found.time.upper})
            all.push_back(std::bit_cast<std::uint64_t>(number));
        return all;
    };
    EXPECT_EQ(bits(a), bits(b));
    EXPECT_EQ(a.certain, b.certain);
    EXPECT_EQ(a.contacts.size(), b.contacts.size());
    EXPECT_EQ(a.overlap.has_value(), b.overlap.has_value());
    EXPECT_EQ(a.inside.has_value(), b.inside.has_value());
}

TEST(PairDistances, AreThoseOfEachPairAlone) {
    Random random(4501);
    int apart = 0, touching = 0, at_start = 0;
    for (int trial = 0; trial < 40; ++trial) {
        SCOPED_TRACE(trial);
        Scene world = moving_octahedra(random, random.integer(2, 8), trial % 2 == 0 ? 0.8 : 9);
        if (world.bodies().size() > 2)
            world.ignore("1", "2");
        const DistanceMatrix found = world.least_distances({.tolerance = 1e-4});
        EXPECT_EQ(found.untested.tested, found.pairs.size());
        std::set<std::pair<std::size_t, std::size_t>> pairs;
        for (const PairDistance& pair : found.pairs) {
            pairs.insert(std::minmax(pair.moving, pair.fixed));
            EXPECT_FALSE(world.is_ignored(pair.moving, pair.fixed));
            EXPECT_FALSE(world.rests(pair.moving)) << "what stands still is the fixed one";
            expect_same(pair.nearest, alone(world, pair, {.tolerance = 1e-4}));
            apart += pair.nearest.distance.lower > 0;
            touching += pair.nearest.distance.upper == 0;
            at_start += pair.nearest.overlap.has_value() || pair.nearest.inside.has_value();
        }
        EXPECT_EQ(pairs.size(), found.pairs.size()) << "each pair once";
        EXPECT_TRUE(std::ranges::is_sorted(found.pairs, {}, [](const PairDistance& pair) {
            return std::pair<std::size_t, std::size_t>(std::minmax(pair.moving, pair.fixed));
        }));
    }
    EXPECT_GT(apart, 150);
    EXPECT_GT(touching, 50);
    EXPECT_GT(at_start, 20);
}

/// Spheres that go straight: the distance of two points, less both radii.
TEST(PairDistances, OfSpheresAreThoseOfClosedForms) {
    Random random(4502);
    Scene world;
    std::vector<Vector3d> starts, ways;
    std::vector<double> radii;
    for (int i = 0; i < 12; ++i) {
        radii.push_back(random.uniform(0.3, 0.9));
        starts.push_back(random_pose(random, 3).translation);
        ways.push_back(i == 0 ? Vector3d(0, 0, 0) : Vector3d(random_pose(random, 3).translation - starts.back()));
        const Pose start(starts.back(), Eigen::Quaterniond::Identity()),
            goal(starts.back() + ways.back(), Eigen::Quaterniond::Identity());
        world.add({std::string(1, char('a' + i)), make_sphere(radii.back()), Motion::velocity(start, goal), ""});
    }
    const DistanceMatrix found = world.least_distances();
    ASSERT_EQ(found.pairs.size(), 66U);
    int touching = 0;
    for (const auto& [a, b, nearest] : found.pairs) {
        const Vector3d at = starts[a] - starts[b], way = ways[a] - ways[b];
        const double time = std::clamp(-at.dot(way) / way.squaredNorm(), 0.0, 1.0);
        const double distance = (at + time * way).norm() - radii[a] - radii[b];
        if (std::abs(distance) < 1e-9)
            continue;
        EXPECT_TRUE(nearest.certain);
        EXPECT_LE(nearest.distance.lower, std::max(0.0, distance));
        EXPECT_NEAR(nearest.distance.upper, std::max(0.0, distance), 1e-6 * std::abs(distance) + 1e-12);
        if (distance > 0) {
            EXPECT_NEAR(nearest.time.lower, time, 1e-3);
            continue;
        }
        ++touching;
        const double c = at.squaredNorm() - std::pow(radii[a] + radii[b], 2), root = at.dot(way);
        const double first = c <= 0 ? 0 : (-root - std::sqrt(root * root - way.squaredNorm() * c)) / way.squaredNorm();
        EXPECT_NEAR(nearest.time.lower, first, 1e-9);
    }
    EXPECT_GT(touching, 5);
    EXPECT_LT(touching, 60);
}

TEST(PairDistances, AreTheSameForAnyNumberOfThreads) {
    Random random(4503);
    const Scene world = moving_octahedra(random, 14, 4);
    const DistanceMatrix one = world.least_distances({}, {.threads = 1});
    for (const unsigned threads : {0U, 2U, 5U}) {
        std::vector<std::size_t> reported;
        const DistanceMatrix found = world.least_distances(
            {}, {.threads = threads, .progress = [&](std::size_t done) { reported.push_back(done); }});
        ASSERT_EQ(found.pairs.size(), one.pairs.size());
        for (std::size_t i = 0; i < one.pairs.size(); ++i) {
            EXPECT_EQ(found.pairs[i].moving, one.pairs[i].moving);
            EXPECT_EQ(found.pairs[i].fixed, one.pairs[i].fixed);
            expect_same(found.pairs[i].nearest, one.pairs[i].nearest);
        }
        EXPECT_EQ(reported.size(), one.pairs.size());
        EXPECT_TRUE(std::ranges::is_sorted(reported));
        EXPECT_EQ(reported.back(), one.pairs.size());
    }
}

/// Pairs that were not searched have brackets, too, and those of pairs far apart say that they are apart.
TEST(PairDistances, AreEnclosedAtALimit) {
    Random random(4504);
    int without_search = 0, apart = 0, searched = 0;
    for (int trial = 0; trial < 20; ++trial) {
        SCOPED_TRACE(trial);
        Scene world = moving_octahedra(random, 9, 12);
        world.add({"ball", make_sphere(2), Motion::at_rest(random_pose(random, 12)), ""});
        const DistanceMatrix truth = world.least_distances({.tolerance = 1e-9});
        for (const std::size_t enough : {std::size_t(0), std::size_t(5)}) {
            std::size_t answered = 0;
            const Limit limit(1e9, [&] { return answered < enough; });
            const DistanceMatrix found =
                world.least_distances({}, {.threads = 1, .progress = [&](std::size_t done) {
                                               answered = done;
                                               if (done == enough) // a limit asks every 20 ms
                                                   std::this_thread::sleep_for(std::chrono::milliseconds(40));
                                           }});
            ASSERT_EQ(found.pairs.size(), truth.pairs.size());
            for (std::size_t i = 0; i < truth.pairs.size(); ++i) {
                const LeastDistance &known = found.pairs[i].nearest, &exact = truth.pairs[i].nearest;
                EXPECT_LE(known.distance.lower, exact.distance.upper);
                EXPECT_GE(known.distance.upper, exact.distance.lower);
                EXPECT_TRUE(std::isfinite(known.distance.upper));
                searched += known.certain;
                without_search += !known.certain && known.contacts.empty();
                apart += !known.certain && known.distance.lower > 0;
            }
        }
    }
    EXPECT_GT(without_search, 800);
    EXPECT_GT(apart, 100);
    EXPECT_GT(searched, 20);
}

/// Two sheets that slide on each other at a billionth of their size take far longer than the limit. The bodies around
/// them, whose boxes are farther apart, have their answers all the same.
TEST(PairDistances, OnePairThatTakesLongTakesNoTimeOfOthers) {
    constexpr std::uint32_t n = 32;
    std::vector<Vector3d> corners;
    for (std::uint32_t i = 0; i <= n; ++i)
        for (std::uint32_t j = 0; j <= n; ++j)
            corners.emplace_back(double(i) / n, double(j) / n, 0);
    const Polyhedron sheet = Polyhedron::from_polygons(corners, grid_triangles(n, n));
    const auto turned = [](double x, double turn) {
        return Pose({x, 0.1, 1e-9}, Eigen::Quaterniond(Eigen::AngleAxisd(turn, Vector3d::UnitZ())));
    };
    OwnTrajectory slide;
    slide.pose_at = [motion = Motion::velocity(turned(0, 0), turned(0.4, 0.8))](double t) { return motion.pose_at(t); };
    slide.bounds = [](double, double) { return MotionBounds{0.81, 0, 0.41, 0}; };
    Scene world;
    world.add({"lower", sheet, Motion::at_rest(Pose()), ""});
    world.add({"upper", sheet, Motion::along(slide), ""});
    for (int i = 0; i < 5; ++i)
        world.add({std::string(1, char('a' + i)), make_sphere(0.1),
                   Motion::at_rest(Pose({0.3 * i, 0, 2}, Eigen::Quaterniond::Identity())), ""});
    const Limit limit(3);
    const DistanceMatrix found = world.least_distances({.tolerance = 0.1}, {.threads = 1});
    ASSERT_EQ(found.pairs.size(), 6U);
    for (const auto& [moving, fixed, nearest] : found.pairs) {
        const bool is_slow = world.bodies()[fixed].name == "lower";
        EXPECT_EQ(nearest.certain, !is_slow) << world.bodies()[fixed].name;
        EXPECT_LE(nearest.distance.lower, is_slow ? 1e-9 : 1.9);
    }
}

TEST(PairDistances, IsEmptyWithoutPairsAndRefusesWhatItCannotUse) {
    Random random(4505);
    EXPECT_TRUE(Scene().least_distances().pairs.empty());
    Scene rest;
    for (const char* name : {"a", "b"})
        rest.add({name, make_sphere(1), Motion::at_rest(random_pose(random, 5)), ""});
    const DistanceMatrix found = rest.least_distances();
    EXPECT_TRUE(found.pairs.empty());
    EXPECT_EQ(found.untested.count(UntestedReason::at_rest), 1U);
    EXPECT_THROW(static_cast<void>(rest.least_distances({.tolerance = 2})), InvalidInput);
}

} // namespace
} // namespace chasles::test
