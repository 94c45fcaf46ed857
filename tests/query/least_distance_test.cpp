// Least distances in closed form, and what an answer says beside the bracket.
#include "chasles/query/least_distance.h"

#include "chasles/base/invalid_input.h"
#include "tests/attack/check_least.h"
#include "tests/mesh/shapes.h"
#include "tests/query/bodies.h"
#include "tests/query/posed_distance.h"
#include "tests/support/even_turn_motion.h"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <set>

namespace chasles::test {
namespace {

const Polyhedron& cube() {
    static const Polyhedron result = box({1, 1, 1}).polyhedron();
    return result;
}

LeastDistance ask(const Polyhedron& moving, const Polyhedron& fixed, const Motion& motion,
                  const LeastDistanceOptions& options = {}) {
    return least_distance({.moving = moving, .fixed = fixed, .motion = motion, .options = options});
}

void expect_distance(const LeastDistance& found, double distance, double tolerance = 1e-6) {
    EXPECT_TRUE(found.certain);
    EXPECT_LE(found.distance.lower, distance);
    EXPECT_GE(found.distance.upper, distance);
    EXPECT_LE(found.distance.upper - found.distance.lower, tolerance * found.distance.upper);
}

TEST(LeastDistance, OfCubesThatPassEachOther) {
    const LeastDistance found =
        ask(cube(), cube(), ScrewMotion::between(shifted(-6, 2.25, 0.5), shifted(5, 2.25, 0.5)));
    expect_distance(found, 0.25);
    ASSERT_EQ(found.contacts.size(), 1u);
    EXPECT_NEAR(found.contacts[0].gap, 0.25, 1e-12);
    EXPECT_NEAR(found.contacts[0].normal.y(), 1, 1e-12);
    EXPECT_NEAR(found.pose.translation.x(), -6 + 11 * found.time.lower, 1e-9);
    EXPECT_LE(std::abs(found.pose.translation.x()), 2 + 1e-9);
}

/// The distance falls until the end, or grows from the start on.
TEST(LeastDistance, AtTheEndsOfTheMotion) {
    for (const bool towards : {true, false}) {
        const Pose far = shifted(6, 0, 0), near = turned({3, 0, 0}, {1, 0, 0}, 0.4);
        const LeastDistance found =
            ask(cube(), cube(), towards ? ScrewMotion::between(far, near) : ScrewMotion::between(near, far));
        expect_distance(found, 1);
        EXPECT_NEAR(found.time.lower, towards ? 1 : 0, 1e-14);
        EXPECT_NEAR(found.time.upper, found.time.lower, 1e-14);
    }
}

/// A cube turns on the spot beside another one: its edge comes nearest when it has turned by 45 degrees.
TEST(LeastDistance, OfATurningEdge) {
    const Pose start = shifted(3, 0, 0), goal = turned({3, 0, 0}, {0, 0, 1}, 1.2);
    const LeastDistance found = ask(cube(), cube(), ScrewMotion::between(start, goal));
    expect_distance(found, 2 - std::numbers::sqrt2);
    EXPECT_NEAR(found.time.lower, std::numbers::pi / 4 / 1.2, 1e-3); // the distance hardly changes about there
    EXPECT_GT(ask(cube(), cube(), ScrewMotion::between(start, turned({3, 0, 0}, {0, 0, 1}, 0.7))).distance.lower,
              found.distance.upper);
}

TEST(LeastDistance, OfAllToleranceAsked) {
    const Motion motion = ScrewMotion::between(shifted(-6, 2.25, 3.5), turned({5, 2.5, 3}, {1, 2, 3}, 1));
    const double distance = ask(cube(), cube(), motion, {.tolerance = 1e-10}).distance.lower;
    for (const double tolerance : {1.0, 1e-2, 1e-6, 1e-9})
        expect_distance(ask(cube(), cube(), motion, {.tolerance = tolerance}), distance * (1 + 5e-11), tolerance);
}

/// Two posts at x = 0 and at `x`, with these heights.
Polyhedron two_posts(double first, double x, double second) {
    Body two = box({0.1, first, 0.1});
    for (const Eigen::Vector3d& v : box({0.1, second, 0.1}).vertices)
        two.vertices.emplace_back(v + Eigen::Vector3d(x, 0, 0));
    for (std::vector<std::uint32_t> face : box({0.1, second, 0.1}).faces) {
        for (std::uint32_t& v : face)
            v += 8;
        two.faces.push_back(face);
    }
    return two.polyhedron();
}

/// Two gaps at two times; the first one is not the least.
TEST(LeastDistance, OfTwoLocalMinima) {
    // Passes the posts at times about 1/4 and 3/4.
    const LeastDistance found = ask(box({0.1, 0.1, 0.1}).polyhedron(), two_posts(1, 4, 1.5),
                                    ScrewMotion::between(shifted(-2, 3, 0), shifted(6, 3, 0)));
    expect_distance(found, 1.4);
    EXPECT_NEAR(found.time.lower, 0.75, 0.03);
}

TEST(LeastDistance, IsZeroWhereTheBodiesTouch) {
    const Motion motion = ScrewMotion::between(shifted(6, 0.1, 0.2), turned({1, 0, 0}, {1, 0, 0}, 0.5));
    const LeastDistance found = ask(cube(), cube(), motion);
    const FirstContact touch = first_contact({.moving = cube(), .fixed = cube(), .motion = motion});
    EXPECT_TRUE(found.certain);
    EXPECT_EQ(found.distance.upper, 0);
    EXPECT_EQ(found.time.lower, touch.time.lower);
    EXPECT_EQ(found.time.upper, touch.time.upper);
    EXPECT_EQ(found.contacts.size(), 1u);
    EXPECT_EQ(found.pose.translation, touch.pose.translation);
}

/// The widest bracket that can be asked for still tells whether the bodies touch.
TEST(LeastDistance, AToleranceOfOneStillProvesSomething) {
    const Motion apart = ScrewMotion::between(shifted(-6, 2.25, 0.5), shifted(5, 2.25, 0.5));
    EXPECT_GT(ask(cube(), cube(), apart, {.tolerance = 1}).distance.lower, 0);
    const Motion through = ScrewMotion::between(shifted(6, 0.1, 0.2), turned({-6, 0, 0}, {1, 0, 0}, 0.5));
    EXPECT_EQ(ask(cube(), cube(), through, {.tolerance = 1}).distance.upper, 0);
}

TEST(LeastDistance, IsZeroWhereTheBodiesOverlapAtTheStart) {
    const LeastDistance found = ask(cube(), cube(), ScrewMotion::between(shifted(0.5, 0.4, 0.3), shifted(9, 0, 0)));
    EXPECT_EQ(found.distance.upper, 0);
    EXPECT_EQ(found.time.upper, 0);
    EXPECT_TRUE(found.overlap);
}

/// A small cube inside a large one touches it; if the large one is not solid, it is at the distance of their faces.
TEST(LeastDistance, InsideAnotherBody) {
    const Polyhedron small = box({0.1, 0.1, 0.1}).polyhedron();
    const Motion motion = ScrewMotion::between(shifted(0, 0, 0), shifted(0.7, 0, 0));
    const Body hollow = box({1, 1, 1});
    expect_distance(ask(small, Polyhedron::from_polygons(hollow.vertices, hollow.faces, {.solid = Solid::no}), motion),
                    0.2);
    const LeastDistance found = ask(small, cube(), motion);
    EXPECT_EQ(found.distance.upper, 0);
    EXPECT_TRUE(found.certain && found.inside && found.inside->moving_is_inside);
}

/// The nearest points are on the features that the answer names, whichever the descent followed.
TEST(LeastDistance, NamesTheNearestFeatures) {
    std::mt19937 random(8);
    int apart = 0;
    std::set<ContactKind> kinds;
    for (int i = 0; i < 200; ++i) {
        const Polyhedron moving = random_octahedron(random).polyhedron();
        const LeastDistance found =
            ask(moving, cube(), ScrewMotion::between(random_pose(random, 4, 2), random_pose(random, 4, 2)));
        if (found.distance.upper <= 0)
            continue;
        ++apart;
        ASSERT_EQ(found.contacts.size(), 1u);
        const Contact& contact = found.contacts[0];
        kinds.insert(contact.kind);
        EXPECT_NEAR(contact.gap, found.distance.upper, 2e-6 * found.distance.upper) << i;
        EXPECT_NEAR(distance_at(moving, cube(), found.pose), found.distance.upper, 1e-12);
        for (const double step : {1.0, 1e-3}) { // no nearer beside the points: the cube is convex
            const Eigen::Vector3d outside = contact.point + step * contact.gap * contact.normal;
            EXPECT_NEAR((outside - outside.cwiseMax(-1).cwiseMin(1)).norm(), step * contact.gap, 1e-9) << i;
        }
    }
    EXPECT_GT(apart, 50);
    EXPECT_GE(kinds.size(), 4u);
}

/// The list of what is near is cut, or empty where rounding hides which edge of a sliver is nearest. What is named then
/// is as far away as the answer says.
TEST(LeastDistance, NamesTheNearestFeaturesFarAway) {
    std::mt19937 random(4);
    int apart = 0;
    const Soup soup = torus(40, 12);
    const Polyhedron ring = Polyhedron::from_polygons(soup.vertices, soup.faces);
    const Polyhedron sliver =
        triangle({-21.5, 29.25, 0}, {-21.5, -25.936, 4.77396e-15}, {-21.5, 25.936, 4.77396e-15}).polyhedron();
    for (int i = 0; i < 60; ++i) {
        const Polyhedron& fixed = i % 2 == 0 ? ring : sliver;
        const Motion rest = Motion::at_rest(random_pose(random, i % 2 == 0 ? 4 : 90, 3));
        const LeastDistance found = ask(ring, fixed, rest);
        if (found.distance.upper <= 0)
            continue;
        ++apart;
        ASSERT_EQ(found.contacts.size(), 1U);
        const Contact& contact = found.contacts[0];
        EXPECT_GE(contact.gap, found.distance.lower * (1 - 1e-9)) << i;
        EXPECT_LE(contact.gap, found.distance.upper * (1 + 1e-9)) << i;
    }
    EXPECT_GT(apart, 50);
}

TEST(LeastDistance, ListsAllNearestFeatures) {
    const Motion motion = ScrewMotion::between(shifted(0, 0, 5), shifted(0.5, 0.5, 2.5));
    EXPECT_EQ(ask(cube(), cube(), motion).contacts.size(), 1u);
    const LeastDistance all = ask(cube(), cube(), motion, {.find = Find::first_with_all_contacts});
    expect_distance(all, 0.5);
    ASSERT_EQ(all.contacts.size(), 4u); // the corners of the common part of both faces
    for (const Contact& contact : all.contacts)
        EXPECT_NEAR(contact.gap, 0.5, 1e-12);
}

TEST(LeastDistance, SwapsRoles) {
    const LeastDistance found =
        ask(cube(), cube(), ScrewMotion::between(shifted(-6, 2.25, 0.5), shifted(5, 2.25, 0.5)));
    const LeastDistance other = found.swapped();
    EXPECT_EQ(other.contacts[0].moving, found.contacts[0].fixed);
    EXPECT_NEAR(other.contacts[0].normal.y(), -1, 1e-12);
    EXPECT_EQ(other.fixed_pose.translation, found.pose.translation);
}

TEST(LeastDistance, OfABatchIsThatOfEachMotion) {
    std::mt19937 random(5);
    std::vector<Motion> motions;
    for (int i = 0; i < 40; ++i)
        motions.emplace_back(ScrewMotion::between(random_pose(random, 4, 3), random_pose(random, 4, 3)));
    std::size_t done = 0;
    const std::vector<LeastDistance> all = least_distance_batch(
        {.moving = cube(), .fixed = cube(), .motions = motions, .batch = {.threads = 3, .progress = [&](std::size_t n) {
                                                                              done = n;
                                                                          }}});
    ASSERT_EQ(all.size(), motions.size());
    EXPECT_EQ(done, motions.size());
    for (std::size_t i = 0; i < motions.size(); ++i) {
        const LeastDistance one = ask(cube(), cube(), motions[i]);
        EXPECT_EQ(all[i].distance.lower, one.distance.lower);
        EXPECT_EQ(all[i].distance.upper, one.distance.upper);
        EXPECT_EQ(all[i].time.lower, one.time.lower);
    }
}

TEST(LeastDistance, RefusesOptionsOutOfRange) {
    const Motion motion = ScrewMotion::between(shifted(5, 0, 0), shifted(4, 0, 0));
    for (const double tolerance : {0.0, -1.0, 2.0, std::nan("")})
        EXPECT_THROW((void)ask(cube(), cube(), motion, {.tolerance = tolerance}), InvalidInput);
    EXPECT_THROW((void)ask(cube(), cube(), motion, {.find = Find::any}), InvalidInput);
    EXPECT_THROW((void)ask(cube(), cube(), motion, {.time_tolerance = 0}), InvalidInput);
}

/// A motion in pieces that only enclose it: the bracket holds for the true one, and is as narrow as asked.
TEST(LeastDistance, OfTheTrueMotionAndNotOfItsPieces) {
    for (const int pieces : {2, 16, 128}) {
        std::vector<double> ends;
        for (int i = 1; i <= pieces; ++i)
            ends.push_back(double(i) / pieces);
        const EvenTurnMotion trajectory({shifted(3, -2, 0), turned({3, 2, 0.5}, {0, 0, 1}, 1.5)}, ends);
        const LeastDistance found = ask(cube(), cube(), motion_of(trajectory));
        double least = 1e300;
        for (int i = 0; i <= 2000; ++i)
            least = std::min(least, distance_at(cube(), cube(), trajectory.pose_at(i / 2000.0)));
        EXPECT_LE(found.distance.lower, least);
        EXPECT_GE(found.distance.upper, least - 1e-4);
        EXPECT_LE(found.distance.upper - found.distance.lower, 1.1e-6 * found.distance.upper);
        EXPECT_TRUE(found.certain);
    }
}

TEST(LeastDistance, OfRandomMotionsThatAreEnclosed) {
    std::mt19937 random(6);
    int apart = 0;
    for (int i = 0; i < 30; ++i) {
        const Pose start = turned(random_vector(random, 1) + Eigen::Vector3d(7, -2, 0), {0, 0, 1}, 0);
        const Pose goal = turned(random_vector(random, 1) + Eigen::Vector3d(7, 2, 0), random_vector(random, 1), 1.5);
        const Motion motion = ConstantVelocity::between(start, goal, random_vector(random, 1));
        const LeastDistance found = ask(cube(), cube(), motion);
        double least = 1e300;
        for (int k = 0; k <= 300; ++k)
            least = std::min(least, distance_at(cube(), cube(), motion.pose_at(k / 300.0)));
        EXPECT_LE(found.distance.lower, least) << i;
        EXPECT_GE(found.distance.upper, least - 1e-3) << i;
        EXPECT_TRUE(found.certain) << i << ": " << found.distance.lower << " " << found.distance.upper << " " << least;
        apart += found.distance.lower > 0 ? 1 : 0;
    }
    EXPECT_GT(apart, 5);
}

/// A small share of `chasles_attack --least`.
TEST(LeastDistance, OfEveryFamilyHoldsInExactArithmetic) {
    std::uint64_t number = 400;
    for (const attack::LeastFamily& family : attack::least_families()) {
        attack::Tally tally;
        ++number;
        for (std::uint64_t index = 0; index < std::uint64_t(600 * family.share); ++index) {
            attack::AttackRandom random(11, number, index);
            const std::string wrong = check(family.make(random), tally);
            if (!wrong.empty())
                ADD_FAILURE() << family.name << ", index " << index << ": " << wrong;
        }
        EXPECT_FALSE(tally.is_broken()) << family.name;
        EXPECT_LT(tally.uncertain * 2, tally.queries) << family.name;
    }
}

} // namespace
} // namespace chasles::test
