// Bodies that start within the margin slide, roll and lift off. They are reported when they come within `hold`.
#include "chasles/base/invalid_input.h"
#include "chasles/query/least_distance.h"
#include "tests/query/bodies.h"

#include <gtest/gtest.h>
#include <numbers>

namespace chasles::test {
namespace {

constexpr double margin = 0.1;
constexpr double hold = 0.02;

const Polyhedron& cube() {
    static const Polyhedron body = box({0.5, 0.5, 0.5}).polyhedron();
    return body;
}

/// A table with its top at z = 1/2, cut into two triangles, and a wall at x = 2.5.
const Polyhedron& table_with_wall() {
    static const Polyhedron body = [] {
        Body result = box({5, 5, 0.5});
        result.faces.pop_back();
        result.faces.push_back({4, 5, 7});
        result.faces.push_back({4, 7, 6});
        add_box(result, {3, 0, 2.6}, {0.5, 4, 2});
        return result.polyhedron();
    }();
    return body;
}

FirstContact ask(const Pose& start, const Pose& goal, const Polyhedron& moving = cube(), double level = hold) {
    return first_contact({.moving = moving,
                          .fixed = table_with_wall(),
                          .motion = ScrewMotion::between(start, goal),
                          .options = {.margin = margin, .hold = level}});
}

TEST(Hold, WithoutItBodiesWithinTheMarginAreInContactAtTheStart) {
    const auto found = first_contact({.moving = cube(),
                                      .fixed = table_with_wall(),
                                      .motion = ScrewMotion::between(shifted(0, 0, 1.05), shifted(1, 0, 1.05)),
                                      .options = {.margin = margin}});
    EXPECT_EQ(found.verdict, Verdict::contact_at_start);
    EXPECT_EQ(found.clear_until, 0);
}

TEST(Hold, ABoxSlidesOverTheDiagonalOfATable) {
    const auto found = ask(shifted(-3, 1, 1.05), shifted(1.5, 1, 1.05));
    EXPECT_EQ(found.verdict, Verdict::clear);
    EXPECT_EQ(found.clear_until, 1);
    ASSERT_EQ(found.held.size(), 4u);
    for (const Contact& contact : found.held)
        EXPECT_NEAR(contact.gap, 0.05, 1e-12);
}

TEST(Hold, ABoxThatIsOutsideTheMarginByRoundingIsHeld) {
    // A motion that stopped at the margin may start the next one just outside of it, and cross it at once.
    const double height = 1 + margin + 1e-14;
    const auto found = ask(shifted(-3, 1, height), turned({1.5, 1, height - 1e-3}, {1, 0, 0}, 1e-4));
    EXPECT_EQ(found.verdict, Verdict::clear);
    EXPECT_EQ(found.held.size(), 4u);
}

TEST(Hold, ABoxSlidesOverTheRimOfATable) {
    EXPECT_EQ(ask(shifted(-3, 1, 1.05), shifted(-8, 1, 1.05)).verdict, Verdict::clear);
}

TEST(Hold, ABoxSlidesOffABoxOfItsSize) {
    // Corners move along rims and leave the margin of edges at the ends of the edges.
    const auto found = first_contact({.moving = cube(),
                                      .fixed = cube(),
                                      .motion = ScrewMotion::between(shifted(0, 0, 1.05), shifted(3, 0, 1.05)),
                                      .options = {.margin = margin, .hold = hold}});
    EXPECT_EQ(found.verdict, Verdict::clear);
}

TEST(Hold, ABoxIsLiftedOffAndTilted) {
    EXPECT_EQ(ask(shifted(0, 0, 1.05), shifted(0, 0, 3)).verdict, Verdict::clear);
    EXPECT_EQ(ask(shifted(0, 0, 1.05), turned({0, 0, 1.4}, {0, 1, 0}, 0.5)).verdict, Verdict::clear);
}

TEST(Hold, APushIsReportedAtTheDistanceThatIsHeld) {
    const auto found = ask(shifted(0, 0, 1.05), shifted(0, 0, 0.95));
    ASSERT_EQ(found.verdict, Verdict::contact);
    EXPECT_NEAR(found.time.lower, 0.3, 1e-11);
    EXPECT_EQ(found.clear_until, found.time.lower);
    ASSERT_EQ(found.contacts.size(), 4u);
    EXPECT_NEAR(found.contacts[0].gap, hold, 1e-11);
}

TEST(Hold, AWallIsReportedAtTheDistanceThatIsHeld) {
    const auto found = ask(shifted(0, 0, 1.05), shifted(4, 0, 1.05));
    ASSERT_EQ(found.verdict, Verdict::contact);
    EXPECT_NEAR(found.time.lower, (2 - hold) / 4, 1e-11);
    EXPECT_EQ(found.clear_until, found.time.lower);
    EXPECT_EQ(found.held.size(), 4u) << "the table";
    ASSERT_FALSE(found.contacts.empty());
    for (const Contact& contact : found.contacts)
        EXPECT_LT((contact.normal + Eigen::Vector3d::UnitX()).norm(), 1e-9) << "the wall";
}

/// More contacts are held than an answer lists: it lists the nearest.
TEST(Hold, OfManyContactsTheNearestAreListed) {
    const Polyhedron moving = bowed_plate(60, 2, 0.5), fixed = bowed_plate(60, 0, 0.49);
    const auto found = first_contact({.moving = moving,
                                      .fixed = fixed,
                                      .motion = ScrewMotion::between(shifted(0, 0, 0), shifted(0, 0, 1)),
                                      .options = {.margin = 2.3, .hold = 1}});
    EXPECT_EQ(found.verdict, Verdict::clear);
    EXPECT_TRUE(found.contacts_cut);
    double least = 3;
    for (const Contact& contact : found.held)
        least = std::min(least, contact.gap);
    const LeastDistance at_rest = least_distance({moving, fixed, ScrewMotion::between(Pose(), Pose())});
    EXPECT_LE(least, at_rest.distance.upper);
}

/// More features are within the margin than a list holds, and none within half of it.
TEST(Hold, FineMeshesAreHeldAtAnyMargin) {
    for (const std::uint32_t n : {40U, 60U, 80U}) {
        const Polyhedron moving = bowed_plate(n, 2, 0.05);
        const Polyhedron fixed = bowed_plate(n, 0, 0);
        for (const double wide : {2.02, 2.1, 2.5, 3.9, 4.1, 30.0}) {
            SCOPED_TRACE(std::to_string(n) + " " + std::to_string(wide));
            const auto moved = [&](double z) {
                return first_contact({.moving = moving,
                                      .fixed = fixed,
                                      .motion = ScrewMotion::between(shifted(0, 0, 0), shifted(0, 0, z)),
                                      .options = {.margin = wide, .hold = 0.2}});
            };
            const FirstContact lifted = moved(1);
            EXPECT_EQ(lifted.verdict, Verdict::clear);
            double least = wide;
            for (const Contact& contact : lifted.held)
                least = std::min(least, contact.gap);
            EXPECT_EQ(least, 2) << "the nearest is listed";
            const FirstContact lowered = moved(-3);
            ASSERT_EQ(lowered.verdict, Verdict::contact);
            EXPECT_NEAR(lowered.time.lower, 0.6, 1e-11);
        }
    }
}

TEST(Hold, TwoContactsOfOnePairAreHeld) {
    const auto found = ask(shifted(1.95, 0, 1.05), shifted(1.97, 1, 1.05));
    EXPECT_EQ(found.verdict, Verdict::clear) << "along the wall and closer to it";
    EXPECT_EQ(found.held.size(), 8u) << "four corners at the table, four at the wall";
}

TEST(Hold, BodiesThatAreTooNearMayLeaveButComeNoNearer) {
    EXPECT_EQ(ask(shifted(0, 0, 1.01), shifted(1, 0, 1.01)).verdict, Verdict::clear);
    EXPECT_EQ(ask(shifted(0, 0, 1.01), shifted(1, 0, 1.02)).verdict, Verdict::clear);
    const auto found = ask(shifted(0, 0, 1.01), shifted(1, 0, 1.0));
    ASSERT_EQ(found.verdict, Verdict::contact);
    EXPECT_LT(found.time.upper, 1e-9);
}

TEST(Hold, BodiesThatTouchAreInContactAtTheStart) {
    const auto found = ask(shifted(0, 0, 1), shifted(0, 0, 2));
    EXPECT_EQ(found.verdict, Verdict::contact_at_start);
    EXPECT_EQ(found.contacts.size(), 4u);
    EXPECT_EQ(ask(shifted(0, 0, 0.7), shifted(0, 0, 2)).verdict, Verdict::contact_at_start);
}

/// A rod stands through a top of four triangles, on the edges between them. No face owns an edge inside a flat part, so
/// no two features are near each other there, and others are within the margin.
TEST(Hold, AnOverlapAtFlatEdgesIsAContactAtTheStart) {
    const auto& [moving, fixed] = rod_through_flat_edges();
    for (const double level : {0.0, 0.05})
        for (const Motion& motion : {Motion(ScrewMotion::between(shifted(0, 0, 0), shifted(0, 0, 0.05))),
                                     Motion::twist(shifted(0, 0, 0), turned({0, 0, 0.05}, {0, 0, 1}, 0.1)),
                                     Motion::velocity(shifted(0, 0, 0), turned({0, 0, 0.05}, {1, 1, 0}, 0.01))}) {
            const auto found = first_contact(
                {.moving = moving, .fixed = fixed, .motion = motion, .options = {.margin = 0.2, .hold = level}});
            EXPECT_EQ(found.verdict, Verdict::contact_at_start) << level;
            EXPECT_EQ(found.clear_until, 0);
        }
}

TEST(Hold, ZeroLetsThemTouchExactly) {
    const auto found = ask(shifted(0, 0, 1.05), shifted(0, 0, 0.95), cube(), 0);
    ASSERT_EQ(found.verdict, Verdict::contact);
    EXPECT_LE(found.time.lower, 0.5);
    EXPECT_GE(found.time.upper, 0.5);
}

TEST(Hold, APrismRollsFromEdgeToEdge) {
    // A decagon of radius 1/2 rolls by one side per step, always half within the margin.
    constexpr int sides = 10;
    const double angle = 2 * std::numbers::pi / sides;
    Body prism;
    prism.faces.resize(2);
    for (std::uint32_t i = 0; i < sides; ++i) {
        const double turn = -std::numbers::pi / 2 + (i + 0.5) * angle;
        for (const double y : {-0.5, 0.5})
            prism.vertices.emplace_back(0.5 * std::cos(turn), y, 0.5 * std::sin(turn));
        const std::uint32_t next = (i + 1) % sides;
        prism.faces[0].push_back(2 * i);
        prism.faces[1].insert(prism.faces[1].begin(), 2 * i + 1);
        prism.faces.push_back({2 * i, 2 * i + 1, 2 * next + 1, 2 * next});
    }
    const Polyhedron roller = prism.polyhedron();
    const double height = 0.5 + 0.5 * std::cos(angle / 2) + 0.05;
    const double side = std::sin(angle / 2); // of radius 1/2
    for (int step = 0; step < 5; ++step) {
        // The turn is about the lower front edge, along y: one side moves down while the other side moves up.
        const double place = -3 + side * step;
        const auto found = ask(turned({place, 0, height}, {0, 1, 0}, angle * step),
                               turned({place + side, 0, height}, {0, 1, 0}, angle * (step + 1)), roller);
        EXPECT_EQ(found.verdict, Verdict::clear) << step;
    }
}

/// The cube sinks onto the hold distance by some roundings, so features seem to come to it early, and do so late, after
/// the cube has come to a wall.
TEST(Hold, WhatTwoFeaturesDoLaterDoesNotHideWhatOthersDoBefore) {
    Body room;
    add_box(room, {8, 0, -0.5}, {16, 4, 0.5});
    add_box(room, {8.3, 0, 1}, {0.05, 3, 0.5});
    const Polyhedron fixed = room.polyhedron();
    Body small;
    add_box(small, {0, 0, 0.25}, {0.25, 0.25, 0.25});
    const Polyhedron moving = small.polyhedron();
    const double wall = (8.25 - 0.25 - hold) / 16;
    for (int i = 0; i < 400; ++i)
        for (const double fall : {1e-12, 3e-12, 1e-11}) {
            const double height = hold + i * 3e-14;
            const auto motion = ScrewMotion::between(shifted(0, 0, height), shifted(16, 0, height - fall));
            const auto found = first_contact(
                {.moving = moving, .fixed = fixed, .motion = motion, .options = {.margin = margin, .hold = hold}});
            EXPECT_LE(found.clear_until, wall + 1e-9) << i << ", " << fall;
        }
}

TEST(Hold, AnyContactStillTellsHowFarOneMayGo) {
    for (const Find find : {Find::first, Find::any}) {
        const auto found = first_contact({.moving = cube(),
                                          .fixed = table_with_wall(),
                                          .motion = ScrewMotion::between(shifted(0, 0, 1.05), shifted(4, 0, 0.9)),
                                          .options = {.margin = margin, .hold = hold, .find = find}});
        ASSERT_EQ(found.verdict, Verdict::contact);
        EXPECT_NEAR(found.clear_until, 0.2, 1e-10) << "with its reserve";
    }
}

TEST(Hold, IsRefusedOutOfRange) {
    EXPECT_THROW(static_cast<void>(ask(Pose(), Pose(), cube(), margin)), InvalidInput);
    EXPECT_THROW(static_cast<void>(ask(Pose(), Pose(), cube(), -0.01)), InvalidInput);
}

TEST(Hold, AScrewThatIsCutHoldsThroughItsPieces) {
    // A turn by 2.5 rad about the vertical axis, in pieces of ten degrees.
    const auto found = ask(shifted(0, 0, 1.05), turned({0, 0, 1.05}, {0, 0, 1}, 2.5));
    EXPECT_EQ(found.verdict, Verdict::clear);
    EXPECT_EQ(found.held.size(), 4u);
}

} // namespace
} // namespace chasles::test
