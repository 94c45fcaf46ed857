// Bodies that start within the margin, on motions that are enclosed: nothing comes nearer than `hold`. Against closed
// forms and dense samples.
#include "chasles/chasles.h"
#include "chasles/query/pair_query.h"
#include "tests/query/bodies.h"
#include "tests/query/posed_distance.h"

#include <gtest/gtest.h>
#include <numbers>

namespace chasles::test {
namespace {

using Eigen::Vector3d;

constexpr double margin = 0.1;
constexpr double hold = 0.02;
constexpr double height = 1.05; // of a cube's centre: it is half of the margin above the table

const Polyhedron& cube() {
    static const Polyhedron body = box({0.5, 0.5, 0.5}).polyhedron();
    return body;
}

/// With its top at z = 1/2.
const Polyhedron& table() {
    static const Polyhedron body = box({9, 9, 0.5}).polyhedron();
    return body;
}

FirstContact ask(const Motion& motion, const Polyhedron& fixed = table(), const Polyhedron& moving = cube(),
                 double level = hold) {
    return first_contact(
        {.moving = moving, .fixed = fixed, .motion = motion, .options = {.margin = margin, .hold = level}});
}

/// A cube on the table is swung about a vertical axis.
Motion swing(double angle) {
    return Motion::hinge({0, 0, 0}, {0, 0, 1}, {0, angle}) * Motion::at_rest(shifted(4, 0, height));
}

TEST(HoldOnAnyMotion, ACubeIsSwungOverATable) {
    const auto found = ask(swing(2.5));
    EXPECT_EQ(found.verdict, Verdict::clear);
    EXPECT_EQ(found.clear_until, 1);
    ASSERT_EQ(found.held.size(), 4u);
    for (const Contact& contact : found.held)
        EXPECT_NEAR(contact.gap, 0.05, 1e-12);
}

TEST(HoldOnAnyMotion, ACubeThatTiltsIsStoppedAtTheDistance) {
    const double total = 0.6;
    const auto found = ask(Motion::velocity(shifted(0, 0, height), turned({0, 0, height}, {1, 0, 0}, total)));
    // The height of the lowest edge above the table: height - cos(angle - pi / 4) / sqrt(2) - 1 / 2.
    const double angle = std::numbers::pi / 4 - std::acos((height - 0.5 - hold) * std::numbers::sqrt2);
    ASSERT_EQ(found.verdict, Verdict::contact);
    EXPECT_TRUE(found.certain);
    EXPECT_NEAR(found.time.lower, angle / total, 1e-11);
    EXPECT_EQ(found.clear_until, found.time.lower);
    for (const Contact& contact : found.contacts)
        EXPECT_NEAR(contact.gap, hold, 1e-11);
}

TEST(HoldOnAnyMotion, AWallIsReportedAtTheHoldDistance) {
    Body room = box({9, 9, 0.5});
    add_box(room, {0, 4.5, 2.6}, {9, 0.5, 2});
    const double angle = std::numbers::pi / 2;
    const auto found = ask(swing(angle), room.polyhedron());
    ASSERT_EQ(found.verdict, Verdict::contact);
    ASSERT_FALSE(found.contacts.empty());
    EXPECT_NEAR(found.contacts.front().gap, hold, 1e-11);
    // The outer corner of the leading side is at the angle atan(0.5 / 4.5) before the arm.
    const double reach = std::hypot(4.5, 0.5);
    EXPECT_NEAR(found.time.lower, (std::asin((4 - hold) / reach) - std::atan2(0.5, 4.5)) / angle, 1e-11);
}

TEST(HoldOnAnyMotion, BodiesThatStartOutsideTheMarginAreToldAtTheMargin) {
    const auto found = ask(Motion::velocity(shifted(0, 0, 2), turned({0, 0, 1.05}, {0, 0, 1}, 1)));
    ASSERT_EQ(found.verdict, Verdict::contact);
    EXPECT_NEAR(found.time.lower, (2 - 1.1) / 0.95, 1e-11);
    EXPECT_TRUE(found.held.empty());
}

TEST(HoldOnAnyMotion, BodiesThatTouchAreInContactAtTheStart) {
    EXPECT_EQ(ask(Motion::velocity(shifted(0, 0, 1), turned({0, 0, 2}, {0, 0, 1}, 1))).verdict,
              Verdict::contact_at_start);
}

/// Contacts after the limit do not matter.
TEST(HoldOnAnyMotion, EndsAtTheTimeThatWasAskedFor) {
    const QueryOptions options{.margin = margin, .hold = hold};
    const Pose start = shifted(0, 0, height);
    const Pose goal = turned({0, 0, height}, {1, 0, 0}, 0.6); // at the hold distance after a twelfth
    for (const Motion& motion : {Motion::velocity(start, goal), Motion(ScrewMotion::between(start, goal))}) {
        const auto found = query::answer({cube().body(), table().body(), motion.trajectory(), options, 0.05});
        EXPECT_EQ(found.verdict, Verdict::clear);
        EXPECT_EQ(found.clear_until, 0.05);
    }
}

struct Tally {
    int stopped = 0;
    int clear = 0;
};

/// Nothing is nearer than the level before `clear_until`, and a contact that is certain is at the level.
void check(const Polyhedron& moving, const Polyhedron& fixed, const Motion& motion, Tally& tally) {
    const double at_start = distance_at(moving, fixed, motion.pose_at(0));
    if (at_start > 0.99 * margin || at_start < 1e-3)
        return;
    const FirstContact found = ask(motion, fixed, moving);
    const double level = std::min(hold, at_start);
    ASSERT_FALSE(found.held.empty());
    for (int i = 0; i <= 200; ++i)
        EXPECT_GE(distance_at(moving, fixed, motion.pose_at(found.clear_until * i / 200)), level - 1e-11);
    if (found.verdict == Verdict::clear) {
        ++tally.clear;
        EXPECT_EQ(found.clear_until, 1);
    } else if (found.time.lower > 0) {
        ++tally.stopped;
        EXPECT_TRUE(found.certain);
        EXPECT_NEAR(distance_at(moving, fixed, motion.pose_at(found.time.lower)), level, 1e-10);
    }
}

TEST(HoldOnAnyMotion, NothingComesNearerThanItIsHeld) {
    std::mt19937 random(45);
    Tally tally;
    for (int i = 0; i < 10000; ++i) {
        const Polyhedron moving = random_octahedron(random).polyhedron();
        const Polyhedron fixed = random_octahedron(random).polyhedron();
        const Pose start = random_pose(random, 2.5, 3);
        const Pose goal = composed(
            start, turned(random_vector(random, 0.3), random_vector(random, 1).normalized(), uniform(random, 0, 0.4)));
        check(moving, fixed, Motion::velocity(start, goal), tally);
    }
    EXPECT_GT(tally.clear, 50);
    EXPECT_GT(tally.stopped, 30);
}

} // namespace
} // namespace chasles::test
