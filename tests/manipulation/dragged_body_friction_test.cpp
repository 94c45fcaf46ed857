// A dragged body with friction against closed forms.
#include "scenes/threaded_fastener.h"
#include "tests/manipulation/drag_scenes.h"

#include <gtest/gtest.h>

#include <iostream>

namespace chasles::test {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

constexpr double margin = 1e-4;

DragOptions with_friction(double coefficient) {
    DragOptions options;
    options.margin = margin;
    options.friction = coefficient;
    return options;
}

Vector3d friction_of(const DragStep& step) {
    Vector3d sum = Vector3d::Zero();
    for (const DragContact& contact : step.contacts)
        sum += contact.friction;
    return sum;
}

void expect_in_cones(const DragStep& step, double coefficient) {
    for (const DragContact& contact : step.contacts) {
        EXPECT_LE(contact.friction.norm(), coefficient * contact.force * (1 + 1e-9));
        EXPECT_NEAR(contact.friction.dot(contact.contact.normal), 0, 1e-12);
    }
}

/// A box of side 1 on a table whose surface is z = 0, pressed by d and pulled by e: it lags by mu d.
TEST(DraggedBodyFriction, APressedBoxLagsByItsFriction) {
    for (const double coefficient : {0.2, 0.7}) {
        Scene scene;
        scene.add({"table", box({9, 9, 0.5}).polyhedron(), Motion::at_rest(shifted(0, 0, -0.5))});
        scene.add({"box", box({0.5, 0.5, 0.5}).polyhedron(), Motion::at_rest(shifted(0, 0, 0.5 + margin))});
        DraggedBody body(scene, "box", with_friction(coefficient));
        const double pressed = 0.3, lag = coefficient * (pressed + margin);
        const Vector3d way(0.6, 0.8, 0);
        double reached = 0; // along the way
        for (const double pulled : {0.5 * lag, 0.99 * lag, 2 * lag, 3 * lag, 2.5 * lag, 1.5 * lag}) {
            DragStep step;
            for (int i = 0; i < 4; ++i)
                step = body.update(Pose(pulled * way + Vector3d(0, 0, 0.5 - pressed), Quaterniond::Identity()));
            // the hand drags it along at the end of its lag, forwards and backwards
            reached = std::clamp(reached, pulled - lag, pulled + lag);
            EXPECT_EQ(step.state, DragState::resting);
            EXPECT_LE((step.pose.translation - reached * way - Vector3d(0, 0, 0.5 + margin)).norm(), 1e-6) << pulled;
            const Vector3d friction = (reached - pulled) * way;
            EXPECT_LE((friction_of(step) - friction).norm(), 1e-6) << pulled;
            EXPECT_LE((step.force - friction - Vector3d(0, 0, pressed + margin)).norm(), 1e-6) << pulled;
            EXPECT_LE(step.torque.norm(), 1e-6);
            expect_in_cones(step, coefficient);
        }
        EXPECT_NEAR(reached, 2 * lag, 1e-12); // in none of both directions after it turned
    }
}

/// Down a slope by what the cone does not hold; pulled straight down by d, a box slides by d (sin - mu cos).
TEST(DraggedBodyFriction, ABoxOnASlopeSlidesJustIfItIsSteeperThanTheCone) {
    const double angle = 0.4, pull = 0.2;
    const Quaterniond tilt(Eigen::AngleAxisd(angle, Vector3d::UnitY()));
    const Vector3d down_slope = tilt * Vector3d::UnitX();
    for (const double share : {1 + 1e-6, 1 - 1e-4, 0.5, 0.0}) {
        Scene scene;
        scene.add({"slope", box({9, 9, 0.5}).polyhedron(), Motion::at_rest(Pose(tilt * Vector3d(0, 0, -0.5), tilt))});
        const Pose start(tilt * Vector3d(0, 0, 0.5 + margin), tilt);
        scene.add({"box", box({0.5, 0.5, 0.5}).polyhedron(), Motion::at_rest(start)});
        const double coefficient = share * std::tan(angle);
        DraggedBody body(scene, "box", with_friction(coefficient));
        DragStep step;
        for (int i = 0; i < 4; ++i) {
            step = body.update(Pose(start.translation - pull * Vector3d::UnitZ(), tilt));
            EXPECT_TRUE(share <= 1 || step.pieces.empty());
        }
        const double slides = std::max(0.0, pull * (std::sin(angle) - coefficient * std::cos(angle)));
        EXPECT_EQ(step.state, DragState::resting);
        EXPECT_LE((step.pose.translation - start.translation - slides * down_slope).norm(), 1e-6) << share;
        expect_in_cones(step, coefficient);
    }
}

/// A bar in a groove, at the margin from both slopes, and pulled out.
TEST(DraggedBodyFriction, AWedgeLocksItselfJustIfTheConeIsWiderThanHalfItsAngle) {
    for (const double half_angle : {0.1, 0.3}) {
        const double width = 3 * std::tan(half_angle);
        Body groove;
        groove.vertices = {{-width, -3, 3}, {width, -3, 3}, {0, -3, 0}, {-width, 3, 3}, {width, 3, 3}, {0, 3, 0}};
        groove.faces = {{0, 2, 5, 3}, {1, 4, 5, 2}};
        const double half = 0.1, height = (half * std::cos(half_angle) + margin) / std::sin(half_angle) + half;
        const auto end_of_pull = [&](double coefficient) {
            Scene scene;
            scene.add({"groove", groove.polyhedron()});
            scene.add({"bar", box({half, 1, half}).polyhedron(), Motion::at_rest(shifted(0, 0, height))});
            DraggedBody body(scene, "bar", with_friction(coefficient));
            const DragStep step = body.update(shifted(0, 0, height + 0.5));
            EXPECT_LE((step.force - Vector3d(0, 0, step.state == DragState::resting ? -0.5 : 0)).norm(), 1e-6);
            expect_in_cones(step, coefficient);
            return step.state;
        };
        EXPECT_EQ(end_of_pull(std::tan(half_angle) * (1 + 1e-5)), DragState::resting);
        EXPECT_EQ(end_of_pull(std::tan(half_angle) * (1 - 1e-5)), DragState::reached);
    }
}

/// The lead angle is that of a slope of one pitch in a circle, and the flanks are tilted by 30 degrees: a nut that is
/// pulled along its bolt turns itself off, unless mu > tan(lead) cos(flank). The facets of the thread are up to
/// sin(pi / n) tan(flank) steeper or less steep.
TEST(DraggedBodyFriction, APulledNutStaysBeyondSelfLocking) {
    const scenes::ThreadedFastener fastener{.bolt_length = 12, .nut_height = 5, .segments = 144};
    const Polyhedron bolt = scenes::bolt(fastener), nut = scenes::nut(fastener);
    const auto rise = [&](double coefficient) {
        Scene scene;
        scene.add({"bolt", bolt});
        scene.add({"nut", nut, Motion::at_rest(shifted(0, 0, 4))});
        DragOptions options = with_friction(coefficient);
        options.margin = 2e-3;
        options.mass = MassProperties{Vector3d(0, 0, 2.5), 0.05 * Eigen::Matrix3d::Identity()};
        DraggedBody body(scene, "nut", options);
        double before = 0;
        for (int i = 0; i < 4; ++i) {
            before = i == 2 ? body.pose().translation.z() : before; // it touches by then
            const Vector3d up(0, 0, body.pose().translation.z() + 1);
            const DragStep step = body.update(Pose(up, Quaterniond(body.pose().rotation)));
            expect_in_cones(step, coefficient);
        }
        return body.pose().translation.z() - before;
    };
    // the depth of the thread that both bodies share is 5/8 of that of a sharp one
    const double radius = (fastener.nominal_diameter - 0.65 * fastener.pitch) / 2;
    const double lead = fastener.pitch / (2 * std::numbers::pi * radius), flank = std::numbers::pi / 6;
    const double facets = std::sin(std::numbers::pi / fastener.segments) * std::tan(flank);
    const double slides = (lead - facets) * std::cos(flank), locks = (lead + facets) * std::cos(flank);
    for (const double coefficient : {0.0, 0.9 * slides})
        EXPECT_GT(rise(coefficient), 0.01) << coefficient;
    for (const double coefficient : {1.1 * locks})
        EXPECT_LT(std::abs(rise(coefficient)), 1e-6) << coefficient;
    std::cout << "slides below " << slides << ", locked above " << locks << std::endl;
}

/// The energy of the spring of a box with equal moments never grows, but for what the way back to the margin costs.
TEST(DraggedBodyFriction, ViolentHandsLoseEnergyAndTouchNothing) {
    Scene scene;
    scene.add({"table", box({5, 5, 0.5}).polyhedron(), Motion::at_rest(shifted(0, 0, -0.5))});
    scene.add({"post", box({0.2, 0.2, 1}).polyhedron(), Motion::at_rest(turned({1, 1, 1.1}, {1, 1, 1}, 0.2))});
    scene.add({"box", box({0.5, 0.4, 0.3}).polyhedron(), Motion::at_rest(shifted(0, 0, 1))});
    DragOptions options = with_friction(0.4);
    const double moment = 0.2;
    options.mass = MassProperties{Vector3d::Zero(), moment * Eigen::Matrix3d::Identity()};
    DraggedBody body(scene, "box", options);
    const auto energy = [&](const Pose& pose, const Pose& goal) {
        const double angle =
            Quaterniond(pose.rotation).normalized().angularDistance(Quaterniond(goal.rotation).normalized());
        return ((goal.translation - pose.translation).squaredNorm() + moment * angle * angle) / 2;
    };
    Random random(7);
    int rubbing = 0, stuck = 0;
    for (int i = 0; i < 300; ++i) {
        const Pose goal = random.chance(0.5)
                              ? random_goal(random, shifted(0.5, 0.5, 0), random.uniform(-1, 1), 0.5)
                              : random_goal(random, body.pose(), random.uniform(-3, 3), random.chance(0.1) ? 10 : 0.5);
        const double stretched = energy(body.pose(), goal);
        const DragStep step = body.update(goal);
        EXPECT_LE(energy(step.pose, goal), stretched + 8 * margin * std::sqrt(2 * stretched)) << i;
        EXPECT_GT(distance_from_others(scene, "box", step.pose), 0) << i;
        expect_in_cones(step, 0.4);
        rubbing += friction_of(step).norm() > 1e-3;
        stuck += step.state == DragState::resting && step.pieces.empty();
    }
    EXPECT_GT(rubbing, 60);
    std::cout << rubbing << " updates end with friction, " << stuck << " did not move" << std::endl;
}

} // namespace
} // namespace chasles::test
