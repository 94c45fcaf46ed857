// Questions that end at a limit: what they have proven until then is true.
#include "chasles/base/limit.h"

#include "chasles/chasles.h"
#include "tests/support/grid.h"

#include <chrono>
#include <cmath>
#include <gtest/gtest.h>
#include <random>
#include <thread>

namespace chasles::test {
namespace {

using Seconds = std::chrono::duration<double>;

/// A square sheet of side 1 in the plane z = 0, of 2 n n triangles.
Polyhedron sheet(std::uint32_t n) {
    std::vector<Eigen::Vector3d> corners;
    for (std::uint32_t i = 0; i <= n; ++i)
        for (std::uint32_t j = 0; j <= n; ++j)
            corners.emplace_back(double(i) / n, double(j) / n, 0);
    return Polyhedron::from_polygons(corners, grid_triangles(n, n));
}

Pose pose(double x, double z, double turn) {
    return {{x, 0.1, z}, Eigen::Quaterniond(Eigen::AngleAxisd(turn, Eigen::Vector3d::UnitZ()))};
}

/// The motion as one of the user's own, of which the library does not know that it keeps to a plane.
Motion as_own(const Motion& motion, double speed, double turn) {
    OwnTrajectory own;
    own.pose_at = [motion](double time) { return motion.pose_at(time); };
    own.bounds = [=](double, double) { return MotionBounds{turn, 0, speed, 0}; };
    return Motion::along(own);
}

/// Slides and turns low above a sheet, and sinks: touches at a time of about 0.9.
Motion landing(double height) {
    return as_own(Motion::velocity(pose(0, height, 0), pose(0.3, -0.1 * height, 0.1)), 0.31, 0.11);
}

TEST(QueryLimit, APairIsProvenClearUntilThen) {
    const Polyhedron lower = sheet(24), upper = sheet(24);
    const FirstContactQuery query{upper, lower, landing(1e-7)};
    const auto start = std::chrono::steady_clock::now();
    const FirstContact whole = first_contact(query);
    const double seconds = Seconds(std::chrono::steady_clock::now() - start).count();
    ASSERT_EQ(whole.verdict, Verdict::contact);
    std::mt19937_64 random(42);
    int unknown = 0, later_than_start = 0;
    for (int i = 0; i < 60; ++i) {
        const Limit limit(std::uniform_real_distribution(0.01, 1.1)(random) * seconds);
        const FirstContact found = first_contact(query);
        if (found.verdict == Verdict::unknown) {
            ++unknown;
            later_than_start += found.clear_until > 0;
            EXPECT_GE(found.clear_until, 0);
            EXPECT_LE(found.clear_until, whole.time.lower);
            EXPECT_TRUE(found.contacts.empty());
            EXPECT_FALSE(found.certain);
        } else {
            EXPECT_EQ(found.time.lower, whole.time.lower);
            EXPECT_EQ(found.time.upper, whole.time.upper);
        }
    }
    EXPECT_GT(unknown, 20);
    EXPECT_GT(later_than_start, 10);
}

/// A motion that turns often has many sections, which are made before the search begins.
TEST(QueryLimit, EndsTheSectionsOfAMotion) {
    const Polyhedron body = sheet(1);
    OwnTrajectory own;
    own.pose_at = [](double time) { return pose(0, 5, 600 * time); };
    own.bounds = [](double, double) {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
        return MotionBounds{600, 0, 0, 0};
    };
    const Motion spin = Motion::along(own);
    const auto start = std::chrono::steady_clock::now();
    const Limit limit(0.05);
    EXPECT_EQ(first_contact({body, body, spin}).verdict, Verdict::unknown);
    EXPECT_LT(Seconds(std::chrono::steady_clock::now() - start).count(), 1);
}

/// One pair of features may take as long as whole bodies.
TEST(QueryLimit, EndsTheRefinementOfOnePairOfFeatures) {
    const Polyhedron lower = sheet(1), upper = sheet(1);
    const Motion slide = as_own(Motion::velocity(pose(0, 1e-10, 0), pose(0.4, 1e-10, 0.8)), 0.41, 0.81);
    const Limit limit(0.01);
    const auto start = std::chrono::steady_clock::now();
    EXPECT_EQ(first_contact({upper, lower, slide}).verdict, Verdict::unknown);
    EXPECT_LT(Seconds(std::chrono::steady_clock::now() - start).count(), 0.1);
}

TEST(QueryLimit, EndsWithinMilliseconds) {
    const Polyhedron lower = sheet(32), upper = sheet(32);
    const Motion slide = as_own(Motion::velocity(pose(0, 1e-9, 0), pose(0.4, 1e-9, 0.8)), 0.41, 0.81);
    for (const double seconds : {0.02, 0.1}) {
        const Limit limit(seconds);
        const auto start = std::chrono::steady_clock::now();
        EXPECT_EQ(first_contact({upper, lower, slide}).verdict, Verdict::unknown);
        EXPECT_LT(Seconds(std::chrono::steady_clock::now() - start).count(), seconds + 0.2);
    }
}

TEST(QueryLimit, ALeastDistanceIsInTheBracketSoFar) {
    const Polyhedron lower = sheet(16), upper = sheet(16);
    const LeastDistanceQuery query{upper, lower,
                                   as_own(Motion::velocity(pose(0, 1e-3, 0), pose(0.4, 1e-3, 0.8)), 0.41, 0.81)};
    int wide = 0;
    for (const double seconds : {1e-9, 0.001, 0.01, 0.05, 0.1}) {
        const Limit limit(seconds);
        const LeastDistance found = least_distance(query);
        EXPECT_LE(found.distance.lower, 1e-3);
        EXPECT_GE(found.distance.upper, 1e-3);
        wide += found.certain ? 0 : 1;
    }
    EXPECT_GE(wide, 2);
}

/// The descents to an upper bound look at the limit, too. Their work tells it, where times would depend on the machine.
TEST(QueryLimit, EndsTheDescentsOfALeastDistance) {
    const auto barrel = [](double radius) {
        constexpr std::uint32_t n = 200;
        std::vector<Eigen::Vector3d> corners;
        for (std::uint32_t i = 0; i <= n; ++i)
            for (std::uint32_t j = 0; j <= n; ++j) {
                const double height = 2.8 * i / n - 1.4, angle = 6.2 * j / n;
                corners.emplace_back(radius * std::cos(height) * std::cos(angle),
                                     radius * std::cos(height) * std::sin(angle), radius * std::sin(height));
            }
        return Polyhedron::from_polygons(corners, grid_triangles(n, n));
    };
    const Polyhedron upper = barrel(1), lower = barrel(1.05);
    const Motion motion = Motion::twist(Pose(), Pose({0.02, 0.01, 0}, Eigen::Quaterniond(1, 0, 0.05, 1)));
    const Limit limit(1e-9);
    const LeastDistance found = least_distance({upper, lower, motion});
    EXPECT_FALSE(found.certain);
    EXPECT_GT(found.distance.upper, 0.0273) << "the least distance";
    EXPECT_LT(found.work.node_pairs, 200'000U) << "those of all descents are four times as many";
}

/// A rough bracket of surfaces that stay near each other takes far less time than a narrow one.
TEST(QueryLimit, ALeastDistanceThatIsCutHasARoughBracket) {
    const Polyhedron lower = sheet(12), upper = sheet(12);
    const LeastDistanceQuery query{upper, lower,
                                   as_own(Motion::velocity(pose(0, 1e-3, 0), pose(0.4, 1e-3, 0.8)), 0.41, 0.81)};
    const auto start = std::chrono::steady_clock::now();
    EXPECT_TRUE(least_distance(query).certain);
    const Limit limit(0.5 * Seconds(std::chrono::steady_clock::now() - start).count());
    const LeastDistance found = least_distance(query);
    EXPECT_GE(found.distance.lower, 4e-4);
    EXPECT_LE(found.distance.upper, 1.1e-3);
}

TEST(QueryLimit, BatchesAndPathsSayWhatTheyDoNotKnow) {
    const Polyhedron lower = sheet(24), upper = sheet(24);
    const std::vector<Motion> motions(8, landing(1e-7));
    const Limit limit(1e-9);
    for (const FirstContact& found : first_contact_batch({.moving = upper, .fixed = lower, .motions = motions}))
        EXPECT_EQ(found.verdict, Verdict::unknown);
    for (const LeastDistance& found : least_distance_batch({.moving = upper, .fixed = lower, .motions = motions})) {
        EXPECT_EQ(found.distance.lower, 0);
        EXPECT_GT(found.distance.upper, 0);
        EXPECT_FALSE(found.certain);
    }
    const PathContact path = first_contact_on_path({upper, lower, motions});
    EXPECT_EQ(path.contact.verdict, Verdict::unknown);
    EXPECT_EQ(path.segment, 0U);
}

/// The segments before the one that is not answered are proven.
TEST(QueryLimit, APathKeepsTheSegmentsThatAreDone) {
    const Polyhedron lower = sheet(64), upper = sheet(64);
    std::vector<Motion> motions(3, Motion::velocity(pose(0, 9, 0), pose(1, 9, 0)));
    motions.push_back(as_own(Motion::velocity(pose(0, 1e-9, 0), pose(0.4, 1e-9, 0.8)), 0.41, 0.81));
    bool enough = false;
    const Limit limit(1e9, [&] { return !enough; });
    const PathContact path =
        first_contact_on_path({upper, lower, motions, {}, [&](std::size_t done) { enough = done == 3; }});
    EXPECT_EQ(path.contact.verdict, Verdict::unknown);
    EXPECT_EQ(path.segment, 3U);
    EXPECT_LT(path.contact.clear_until, 1);
}

/// Segments that are answered at once end at the limit, too.
TEST(QueryLimit, APathOfManyQuickSegmentsEndsSoon) {
    const Polyhedron body = sheet(1);
    const std::vector<Motion> motions(1'000'000, Motion::velocity(pose(0, 9, 0), pose(1, 9, 0)));
    std::size_t last = 0;
    const Limit limit(1e9, [&] { return last < 3; });
    const PathContact path = first_contact_on_path({body, body, motions, {}, [&](std::size_t done) { last = done; }});
    EXPECT_EQ(path.contact.verdict, Verdict::unknown);
    EXPECT_GE(path.segment, 3U);
    EXPECT_LT(path.segment, motions.size() - 1);
    EXPECT_EQ(path.contact.clear_until, 0);
}

TEST(QueryLimit, AnExceptionOfTheFunctionComesOut) {
    const Polyhedron lower = sheet(32), upper = sheet(32);
    const Motion slide = as_own(Motion::velocity(pose(0, 1e-9, 0), pose(0.4, 1e-9, 0.8)), 0.41, 0.81);
    const Limit limit(1e9, []() -> bool { throw std::runtime_error("enough"); });
    EXPECT_THROW((void)first_contact({upper, lower, slide}), std::runtime_error);
}

} // namespace
} // namespace chasles::test
