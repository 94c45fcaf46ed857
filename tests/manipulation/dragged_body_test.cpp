// A dragged body against closed forms.
#include "scenes/threaded_fastener.h"
#include "tests/manipulation/drag_scenes.h"
#include "tests/support/refusal.h"

#include <gtest/gtest.h>

#include <numbers>

namespace chasles::test {
namespace {

using Eigen::Vector3d;

constexpr double margin = 1e-4;

/// A box of side 1 above a table whose surface is z = 0.
Scene box_and_table() {
    Scene scene;
    scene.add({"table", box({5, 5, 0.5}).polyhedron(), Motion::at_rest(shifted(0, 0, -0.5))});
    scene.add({"box", box({0.5, 0.5, 0.5}).polyhedron(), Motion::at_rest(shifted(0, 0, 1))});
    return scene;
}

double place_error(const DragStep& step, const Vector3d& place) {
    return (step.pose.translation - place).norm();
}

TEST(DraggedBody, ReachesAGoalThatIsFreeExactly) {
    Scene scene = box_and_table();
    DraggedBody body(scene, "box", {.margin = margin});
    const Pose goal = turned({1, 2, 3}, {1, 1, 0}, 2);
    const DragStep step = body.update(goal);
    EXPECT_EQ(step.state, DragState::reached);
    EXPECT_EQ(step.distance, 0);
    EXPECT_EQ(step.pose.translation, goal.translation);
    EXPECT_EQ(step.force, Vector3d::Zero());
    EXPECT_TRUE(step.contacts.empty());
    EXPECT_EQ(scene.bodies()[1].motion.pose_at(0).translation, goal.translation);
    EXPECT_TRUE(body.update(goal).pieces.empty());
}

TEST(DraggedBody, ABoxSlidesOnATableAndFeelsTheNormalPart) {
    Scene scene = box_and_table();
    DraggedBody body(scene, "box", {.margin = margin, .stiffness = 3});
    for (int i = 0; i < 20; ++i) {
        const Vector3d wanted(0.1 * i, -0.05 * i, 0.4);
        const DragStep step = body.update(turned(wanted, Vector3d::UnitZ(), 0.1 * i));
        EXPECT_EQ(step.state, DragState::resting);
        EXPECT_LE(place_error(step, {wanted.x(), wanted.y(), 0.5 + margin}), 1e-9) << i;
        EXPECT_NEAR(Eigen::Quaterniond(step.pose.rotation)
                        .angularDistance(Eigen::Quaterniond(Eigen::AngleAxisd(0.1 * i, Vector3d::UnitZ()))),
                    0, 1e-7);
        EXPECT_LE((step.force - Vector3d(0, 0, 3 * (0.1 + margin))).norm(), 1e-9);
        EXPECT_LE(step.torque.norm(), 1e-6);
        EXPECT_EQ(step.contacts.size(), 4U);
        EXPECT_EQ(step.blocking, std::vector<std::size_t>{0});
        EXPECT_NEAR(step.distance, 0.1 + margin, 1e-9);
        EXPECT_EQ(step.events.size(), i == 0 ? 4U : 0U) << i;
    }
    const DragStep lifted = body.update(shifted(0, 0, 2));
    EXPECT_EQ(lifted.state, DragState::reached);
    ASSERT_EQ(lifted.events.size(), 4U);
    EXPECT_FALSE(lifted.events.front().begins);
}

/// A contact is listed within the reach, and within two margins.
TEST(DraggedBody, ListsContactsWithinTheReachAndTwoMargins) {
    const auto contacts_at = [](double gap, double reach) {
        Scene scene = box_and_table();
        const Pose above = shifted(0, 0, 0.5 + gap * margin);
        scene.move(1, Motion::at_rest(above));
        DraggedBody body(scene, "box", {.margin = margin, .reach = reach * margin});
        EXPECT_EQ(body.reach(), (reach == 0 ? 1.25 : reach) * margin);
        return body.update(above).contacts.size();
    };
    EXPECT_EQ(contacts_at(1.2, 0), 4U);
    EXPECT_EQ(contacts_at(1.3, 0), 0U);
    EXPECT_EQ(contacts_at(1.3, 2), 4U);
    EXPECT_EQ(contacts_at(1.9, 4), 4U);
    EXPECT_EQ(contacts_at(2.1, 4), 0U);
}

TEST(DraggedBody, ATiltedPushTurnsTheBoxFlat) {
    Scene scene = box_and_table();
    DraggedBody body(scene, "box", {.margin = margin});
    DragStep step;
    for (int i = 0; i < 5; ++i)
        step = body.update(turned({0.3, 0.1, -2}, {1, 2, 0}, 0.4));
    EXPECT_EQ(step.state, DragState::resting);
    EXPECT_LE(place_error(step, {0.3, 0.1, 0.5 + margin}), 1e-6);
    EXPECT_LE((step.force - Vector3d(0, 0, 2.5 + margin)).norm(), 1e-6);
}

/// The edge on which the box turns leaves the table to second order, and the step makes up for it.
TEST(DraggedBody, ABoxThatTurnsOnItsEdgeNeedsFewSteps) {
    Scene scene = box_and_table();
    DraggedBody body(scene, "box", {.margin = margin});
    EXPECT_EQ(body.update(shifted(0, 0, 0.49)).state, DragState::resting);
    for (const double angle : {0.2, 0.45, 0.7, 0.5}) {
        const double height = std::sqrt(0.5) * std::cos(std::numbers::pi / 4 - angle); // where an edge touches
        const DragStep step = body.update(turned({0, 0, height - 1e-3}, Vector3d::UnitY(), angle));
        EXPECT_EQ(step.state, DragState::resting);
        EXPECT_LE(step.pieces.size(), 4U) << angle;
        EXPECT_NEAR(distance_from_others(scene, "box", step.pose), margin, margin / 8) << angle;
        EXPECT_LE(place_error(step, {0, 0, height}), 0.01) << angle;
    }
}

TEST(DraggedBody, ABoxInACornerFeelsAllThreeWalls) {
    Scene scene;
    scene.add({"corner", corner(4).polyhedron()});
    scene.add({"box", box({0.5, 0.5, 0.5}).polyhedron(), Motion::at_rest(shifted(2, 2, 2))});
    DraggedBody body(scene, "box", {.margin = margin});
    DragStep step;
    for (int i = 0; i < 5; ++i)
        step = body.update(shifted(-0.5, -1.5, 0.2));
    EXPECT_EQ(step.state, DragState::resting);
    EXPECT_LE(place_error(step, Vector3d::Constant(0.5 + margin)), 1e-6);
    const Vector3d force = Vector3d::Constant(0.5 + margin) - Vector3d(-0.5, -1.5, 0.2);
    EXPECT_LE((step.force - force).norm(), 1e-6);
    EXPECT_LE(step.torque.norm(), 1e-6);
}

/// A prism of three sides, point down, between two slopes of 45 degrees: where its edges touch, the planes of the
/// slopes hold it.
TEST(DraggedBody, AWedgeCentresABarAndBothSidesPush) {
    Body groove;
    groove.vertices = {{-3, -3, 3}, {3, -3, 3}, {0, -3, 0}, {-3, 3, 3}, {3, 3, 3}, {0, 3, 0}};
    groove.faces = {{0, 2, 5, 3}, {1, 4, 5, 2}};
    Scene scene;
    scene.add({"groove", groove.polyhedron()});
    scene.add({"bar", box({0.3, 1, 0.3}).polyhedron(), Motion::at_rest(shifted(0, 0, 2))});
    DraggedBody body(scene, "bar", {.margin = margin});
    DragStep step;
    for (int i = 0; i < 8; ++i)
        step = body.update(shifted(0.1, 0.5, 0));
    EXPECT_EQ(step.state, DragState::resting);
    // the lower edges at (+-0.3, z - 0.3) are at the margin from the planes |x| = z
    const double height = 0.6 + std::sqrt(2) * margin;
    EXPECT_LE(place_error(step, {0, 0.5, height}), 1e-6);
    EXPECT_LE((step.force - Vector3d(-0.1, 0, height)).norm(), 1e-6);
    double sides[2] = {0, 0};
    for (const DragContact& contact : step.contacts)
        sides[contact.contact.normal.x() > 0] += contact.force;
    // normals (+-1, 0, 1) / sqrt(2)
    EXPECT_NEAR(sides[0], (height + 0.1) / std::sqrt(2), 1e-6);
    EXPECT_NEAR(sides[1], (height - 0.1) / std::sqrt(2), 1e-6);
}

/// A prism in a prismatic hole of as many sides, both with their corners at the same angles: pulled towards the middle
/// of a side, it stops with its side at the margin from that of the hole.
TEST(DraggedBody, APrismInAPrismaticHoleStopsAtItsSides) {
    constexpr int sides = 12;
    Scene scene;
    scene.add({"plate", plate_with_hole(sides, 1.2, 3, 1).polyhedron()});
    scene.add({"peg", prism(sides, 1, 3).polyhedron(), Motion::at_rest(shifted(0, 0, -1))});
    DraggedBody body(scene, "peg", {.margin = margin});
    const double half = std::numbers::pi / sides, play = 0.2 * std::cos(half) - margin;
    for (int i = 0; i < 2 * sides; ++i) {
        const double angle = half * i;
        const Vector3d way(std::cos(angle), std::sin(angle), 0);
        // the middle of a side, or a corner: there two sides hold
        const double reached = i % 2 == 1 ? play : play / std::cos(half);
        DragStep step;
        for (int k = 0; k < 6; ++k)
            step = body.update(Pose(Vector3d(0.5 * way.x(), 0.5 * way.y(), -1), Eigen::Quaterniond::Identity()));
        EXPECT_EQ(step.state, DragState::resting);
        EXPECT_LE(place_error(step, reached * way - Vector3d::UnitZ()), 1e-6) << i;
        EXPECT_LE((step.force + (0.5 - reached) * way).norm(), 1e-6) << i;
    }
}

TEST(DraggedBody, BodiesThatMoveInAreReported) {
    Scene scene = box_and_table();
    DraggedBody body(scene, "box", {.margin = margin});
    EXPECT_TRUE(body.update(shifted(0, 0, 1)).intrusions.empty());
    // through the box, and on
    scene.move(0, Motion::velocity(shifted(0, 0, -0.5), shifted(0, 0, 5)));
    const DragStep through = body.update(shifted(0, 0, 1));
    ASSERT_EQ(through.intrusions.size(), 1U);
    EXPECT_EQ(through.intrusions[0].body, 0U);
    EXPECT_NEAR(through.intrusions[0].contact.time.lower, 0.5 / 5.5, 1e-9);
    // into the box, and there it stays
    scene.move(0, Motion::at_rest(shifted(0, 0, 0.1)));
    const DragStep inside = body.update(shifted(0, 0, 3));
    EXPECT_EQ(inside.state, DragState::touching);
    EXPECT_EQ(inside.touching, std::vector<std::size_t>{0});
    EXPECT_TRUE(inside.pieces.empty());
    // away again
    scene.move(0, Motion::at_rest(shifted(0, 0, -0.5)));
    EXPECT_EQ(body.update(shifted(0, 0, 3)).state, DragState::reached);
}

TEST(DraggedBody, ABodyThatComesWithinTheMarginPushes) {
    Scene scene = box_and_table();
    DraggedBody body(scene, "box", {.margin = margin});
    const Pose low = shifted(0, 0, 0.4);
    EXPECT_EQ(body.update(low).state, DragState::resting);
    for (int i = 1; i <= 20; ++i) {
        const double height = i * margin / 2;
        scene.move(0, Motion::at_rest(shifted(0, 0, height - 0.5)));
        EXPECT_LE(place_error(body.update(low), {0, 0, 0.5 + height + margin}), margin / 8) << i;
    }
}

TEST(DraggedBody, BodiesMayBeRemovedAndAdded) {
    Scene scene;
    scene.add({"far", box({1, 1, 1}).polyhedron(), Motion::at_rest(shifted(50, 0, 0))});
    scene.add({"box", box({0.5, 0.5, 0.5}).polyhedron(), Motion::at_rest(shifted(0, 0, 1))});
    scene.add({"table", box({5, 5, 0.5}).polyhedron(), Motion::at_rest(shifted(0, 0, -0.5))});
    DraggedBody body(scene, "box", {.margin = margin});
    const Pose low = shifted(0, 0, 0.4);
    EXPECT_EQ(body.update(low).blocking, std::vector<std::size_t>{2});
    scene.remove("far"); // the table takes its index
    const DragStep renumbered = body.update(low);
    EXPECT_EQ(renumbered.blocking, std::vector<std::size_t>{0});
    EXPECT_TRUE(renumbered.events.empty());
    scene.remove("table"); // the box takes its index
    const DragStep alone = body.update(low);
    EXPECT_EQ(alone.state, DragState::reached);
    EXPECT_TRUE(alone.events.empty());
    scene.add({"floor", box({5, 5, 0.5}).polyhedron(), Motion::at_rest(shifted(0, 0, -1))});
    EXPECT_EQ(body.update(shifted(0, 0, -1)).events.size(), 4U);
    EXPECT_NEAR(body.pose().translation.z(), margin, 1e-9);
}

TEST(DraggedBody, AnOverlapAtFlatEdgesTouches) {
    const auto& [rod, block] = rod_through_flat_edges();
    Scene scene;
    scene.add({"block", block, Motion::at_rest(Pose())});
    scene.add({"rod", rod, Motion::at_rest(Pose())});
    DraggedBody body(scene, "rod", {.margin = 0.2});
    EXPECT_EQ(body.update(shifted(0, 0, 0.05)).state, DragState::touching);
}

/// A program puts the body elsewhere, or another hand does: each hand goes on from there.
TEST(DraggedBody, GoesOnFromWhereTheSceneHasMovedIt) {
    Scene scene = box_and_table();
    scene.add({"wall", box({0.5, 5, 5}).polyhedron(), Motion::at_rest(shifted(10.5, 0, 0))});
    DraggedBody body(scene, "box", {.margin = margin});
    static_cast<void>(body.update(shifted(0, 0, 2)));
    scene.move(1, Motion::at_rest(shifted(20, 0, 2)));
    const DragStep step = body.update(shifted(16, 0, 2));
    EXPECT_EQ(step.state, DragState::reached) << "the wall is behind the box";
    ASSERT_FALSE(step.pieces.empty());
    EXPECT_EQ(step.pieces.front().motion.pose_at(0).translation, Vector3d(20, 0, 2));

    DraggedBody other(scene, "box", {.margin = margin});
    EXPECT_EQ(other.update(shifted(17, 1, 3)).state, DragState::reached);
    EXPECT_EQ(body.update(shifted(16, 1, 3)).pieces.front().motion.pose_at(0).translation, Vector3d(17, 1, 3));
}

/// What touches cannot be kept apart, so nothing moves until somebody puts the body a hair away.
TEST(DraggedBody, ABodyThatTouchesMovesOnceTheSceneHasMovedItAway) {
    Scene scene = box_and_table();
    scene.move(1, Motion::at_rest(shifted(0, 0, 0.5)));
    DraggedBody body(scene, "box", {.margin = margin});
    EXPECT_EQ(body.update(shifted(0, 0, 3)).state, DragState::touching);
    scene.move(1, Motion::at_rest(shifted(0, 0, 0.5 + margin / 100)));
    EXPECT_EQ(body.update(shifted(0, 0, 3)).state, DragState::reached);
}

TEST(DraggedBody, BodiesThatAreIgnoredDoNotStopIt) {
    Scene scene = box_and_table();
    scene.ignore("box", "table");
    DraggedBody body(scene, "box", {.margin = margin});
    EXPECT_EQ(body.update(shifted(0, 0, -2)).state, DragState::reached);
}

/// One round is always done.
TEST(DraggedBody, StopsWhenTheTimeIsOver) {
    Scene scene = box_and_table();
    DraggedBody body(scene, "box", {.margin = margin});
    const Pose goal = turned({0.3, 0.1, -2}, {1, 2, 0}, 0.4);
    const DragStep first = body.update(goal, 1e-12);
    EXPECT_EQ(first.state, DragState::moving);
    EXPECT_EQ(first.pieces.size(), 1U);
    DragStep last;
    for (int i = 0; i < 40; ++i)
        last = body.update(goal, 1e-12);
    EXPECT_EQ(last.state, DragState::resting);
    EXPECT_LE(place_error(last, {0.3, 0.1, 0.5 + margin}), 1e-6);
}

/// A nut goes along its thread by a sixth of a turn: the way is free, but tight.
TEST(DraggedBody, ALongSearchEndsAStepIfTimeIsShort) {
    const scenes::ThreadedFastener fastener;
    const auto along_the_thread = [&](double turns) {
        return turned({0, 0, 8 + turns * fastener.pitch}, Vector3d::UnitZ(), 2 * std::numbers::pi * turns);
    };
    const auto first_step = [&](double seconds) {
        Scene scene;
        scene.add({"bolt", scenes::bolt(fastener)});
        scene.add({"nut", scenes::nut(fastener), Motion::at_rest(along_the_thread(0))});
        DraggedBody body(scene, "nut", {.rounds = 1});
        return body.update(along_the_thread(1.0 / 6), seconds);
    };
    const DragStep whole = first_step(0);
    EXPECT_EQ(whole.state, DragState::reached);
    EXPECT_EQ(whole.pieces.size(), 1U);
    const DragStep urgent = first_step(1e9);
    EXPECT_EQ(urgent.state, DragState::moving);
    ASSERT_EQ(urgent.pieces.size(), 1U);
    EXPECT_EQ(urgent.pieces.front().until, 1); // not blocked
    EXPECT_LT(urgent.work.node_pairs, whole.work.node_pairs);
    EXPECT_GT(urgent.distance, 0.1 * fastener.pitch);
}

TEST(DraggedBody, RefusesWhatItCannotUse) {
    Scene scene = box_and_table();
    const auto refusal_with = [&](const DragOptions& options) {
        return refusal([&] { DraggedBody(scene, "box", options); });
    };
    EXPECT_EQ(refusal([&] { DraggedBody(scene, "nut"); }), "scene: nut: is not in the scene");
    EXPECT_EQ(refusal_with({.margin = -1}), "drag: margin: must be in (0, 1e30], or 0 for the default");
    EXPECT_EQ(refusal_with({.margin = 1, .reach = 1}),
              "drag: reach: must be at least 1.25 times the margin, and at most 1e30");
    const std::string too_near =
        ", and so too near to its rounding; give a larger one, or put the bodies near the origin";
    EXPECT_TRUE(refusal_with({.margin = 1e-10})
                    .starts_with("drag: margin: 1e-10 is below a 2^28th of the lengths of the pose, "));
    EXPECT_TRUE(refusal_with({.margin = 1e-10}).ends_with(too_near));
    // The culprit of a far goal is the goal, not the margin that has served so far.
    DraggedBody box(scene, "box", {.margin = 1e-3});
    for (const std::string& text : {refusal([&] { (void)box.update(shifted(1e6, 0, 0)); }),
                                    refusal([&] { (void)box.force(shifted(1e6, 0, 0)); })}) {
        EXPECT_TRUE(text.starts_with("drag: goal: is too far away: the margin, 0.001, is below a 2^28th of "));
        EXPECT_TRUE(text.ends_with("give a goal that is nearer to the origin, or drag with a larger margin"));
    }
    EXPECT_EQ(box.update(shifted(0, 0, 1)).state, DragState::reached);
    EXPECT_EQ(refusal_with({.stiffness = 0}), "drag: stiffness: must be in (0, 1e30]");
    EXPECT_EQ(refusal_with({.rounds = 0}), "drag: rounds: must be positive");
    EXPECT_EQ(refusal_with({.mass = MassProperties{Vector3d::Zero(), -Eigen::Matrix3d::Identity()}}),
              "drag: mass: the inertia must be symmetric and positive definite");
    EXPECT_EQ(refusal_with({.friction = -0.1}), "drag: friction: must be in [0, 100]");
    EXPECT_EQ(refusal_with({.friction = std::nan("")}), "drag: friction: must be in [0, 100]");
    EXPECT_EQ(refusal_with({.lock = {DragLockKind::plane, Vector3d::Zero(), {}}}),
              "drag: lock: the direction must be finite and not zero");
    DraggedBody body(scene, "box");
    EXPECT_EQ(refusal([&] { (void)body.update(Pose(), -1); }), "drag: seconds: must not be negative");
    scene.remove("box");
    EXPECT_EQ(refusal([&] { (void)body.update(Pose()); }), "scene: box: is not in the scene");
}

/// Neighbours that are known from the steps before save time and nothing else: a hand that begins anew goes the same
/// way.
TEST(DraggedBody, WhatItRemembersChangesNoStep) {
    const Polyhedron moving = torus(1, 0.3, 24, 10).polyhedron(), fixed = torus(1, 0.3, 26, 11).polyhedron();
    const auto scene_at = [&](const Pose& pose) {
        Scene scene;
        scene.add({"fixed", fixed});
        scene.add({"moving", moving, Motion::at_rest(pose)});
        return scene;
    };
    Scene scene = scene_at(turned({1, 0, 0}, Vector3d::UnitX(), 1.5));
    DraggedBody body(scene, "moving");
    std::size_t contacts = 0;
    int compared = 0;
    for (int i = 0; i < 120; ++i) {
        const Pose goal = turned({1.5 + 0.1 * std::sin(0.3 * i), 0.1 * std::sin(0.2 * i), 0.1 * std::cos(0.3 * i)},
                                 Vector3d::UnitX(), 1.5 + 0.3 * std::sin(0.1 * i));
        Scene other = scene_at(body.pose());
        DraggedBody anew(other, "moving");
        const bool is_same_start = anew.pose().rotation.coeffs() == body.pose().rotation.coeffs();
        const DragStep step = body.update(goal), expected = anew.update(goal);
        if (!is_same_start) // a scene rounds the rotation to unit length once more
            continue;
        ++compared;
        contacts += step.contacts.size();
        EXPECT_LE((step.pose.translation - expected.pose.translation).norm(), 1e-9) << i;
        EXPECT_LE((step.pose.rotation.coeffs() - expected.pose.rotation.coeffs()).norm(), 1e-9) << i;
        EXPECT_EQ(step.contacts.size(), expected.contacts.size()) << i;
        EXPECT_LE((step.force - expected.force).norm(), 1e-9) << i;
    }
    EXPECT_GT(compared, 20);
    EXPECT_GT(contacts, 30U);
}

} // namespace
} // namespace chasles::test
