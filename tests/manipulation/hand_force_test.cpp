// Forces on the hand from the last contacts, also while another thread updates.
#include "tests/manipulation/drag_scenes.h"
#include "tests/support/refusal.h"

#include <gtest/gtest.h>

#include <atomic>
#include <iostream>
#include <thread>

namespace chasles::test {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

constexpr double margin = 1e-4;

Scene box_on_table() {
    Scene scene;
    scene.add({"table", box({9, 9, 0.5}).polyhedron(), Motion::at_rest(shifted(0, 0, -0.5))});
    scene.add({"box", box({0.5, 0.5, 0.5}).polyhedron(), Motion::at_rest(shifted(0, 0, 0.5 + margin))});
    return scene;
}

DragOptions options_with(double friction) {
    DragOptions options;
    options.margin = margin;
    options.stiffness = 3;
    options.friction = friction;
    return options;
}

TEST(HandForce, IsThatOfTheUpdateForTheSameGoal) {
    Random random(1);
    int pressed = 0;
    for (const double friction : {0.0, 0.5}) {
        Scene scene = box_on_table();
        DraggedBody body(scene, "box", options_with(friction));
        for (int i = 0; i < 30; ++i) {
            const Pose goal = random_goal(random, shifted(0, 0, 0.4), random.uniform(-0.3, 0.3), 0.5);
            const DragStep step = body.update(goal);
            const DragForce force = body.force(goal);
            EXPECT_EQ(force.force, step.force);
            EXPECT_EQ(force.torque, step.torque);
            pressed += force.force.norm() > 0;
        }
    }
    EXPECT_GT(pressed, 30);
}

TEST(HandForce, FollowsTheHandWithoutAnUpdate) {
    Scene scene = box_on_table();
    DraggedBody body(scene, "box", options_with(0.5));
    // before the first update: from where the body starts
    EXPECT_LE((body.force(shifted(0, 0, 0.3)).force - Vector3d(0, 0, 3 * (0.2 + margin))).norm(), 1e-9);
    EXPECT_EQ(body.update(shifted(0, 0, 0.4)).state, DragState::resting);
    for (const double depth : {-0.1, 0.0, 0.1, 0.7})
        for (const double pull : {0.0, 0.04, 0.4}) {
            const DragForce found = body.force(shifted(pull, 0, 0.5 - depth));
            const double push = std::max(0.0, depth + margin);
            // where it slides, the tip of the box is not lifted by so little
            const Vector3d wanted(-std::min(pull, 0.5 * push), 0, push);
            EXPECT_LE((found.force - 3 * wanted).norm(), 1e-6) << depth << " " << pull;
        }
    EXPECT_EQ(body.pose().translation.x(), 0);
    EXPECT_NE(refusal([&] { (void)body.force(Pose(Vector3d(0, std::nan(""), 0), Quaterniond::Identity())); }), "");
}

TEST(HandForce, ContactsThatDoNotTouchDoNotPush) {
    for (const auto& [gap, pushes] : {std::pair(1.1, true), std::pair(1.5, false)}) {
        Scene scene;
        scene.add({"table", box({9, 9, 0.5}).polyhedron(), Motion::at_rest(shifted(0, 0, -0.5))});
        scene.add({"box", box({0.5, 0.5, 0.5}).polyhedron(), Motion::at_rest(shifted(0, 0, 0.5 + gap * margin))});
        for (const double friction : {0.0, 0.5}) {
            const DraggedBody body(scene, "box", options_with(friction));
            EXPECT_EQ(body.force(shifted(0.1, 0, 0)).force.norm() > 0, pushes) << gap;
        }
    }
}

/// The hand presses by 0.1 wherever the box is, so each answer is known however the threads interleave.
TEST(HandForce, MayBeAskedForWhileAnotherThreadUpdates) {
    Scene scene = box_on_table();
    DraggedBody body(scene, "box", options_with(0));
    std::atomic<bool> is_over = false;
    std::atomic<int> answers = 0, wrong = 0;
    std::thread haptics([&] {
        for (int i = 0; !is_over; ++i) {
            const DragForce found = body.force(shifted(1e-3 * (i % 1000), 0, 0.4));
            wrong += !((found.force - Vector3d(0, 0, 3 * (0.1 + margin))).norm() <= 1e-9);
            ++answers;
        }
    });
    for (int i = 0; i < 200 || answers < 100; ++i)
        (void)body.update(shifted(0.01 * (i % 200), 0, 0.4));
    is_over = true;
    haptics.join();
    EXPECT_EQ(wrong, 0);
    std::cout << answers << " answers" << std::endl;
}

} // namespace
} // namespace chasles::test
