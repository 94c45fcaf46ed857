// Trajectories of the user's own: the test kit finds bounds that are too small, and bad input gets one clear error.
#include "chasles/motion/own_trajectory.h"

#include "chasles/base/invalid_input.h"
#include "chasles/motion/motion.h"
#include "tests/support/refusal.h"

#include <Eigen/Geometry>
#include <chrono>
#include <gtest/gtest.h>
#include <limits>

namespace chasles::test {
namespace {

using Eigen::Vector3d;

/// A swing: the angle is sin(3 t) about a line through (1, 0, 0) along z, the body slides by t^3 along it.
OwnTrajectory swing() {
    OwnTrajectory own;
    own.pose_at = [](double t) {
        const Eigen::Isometry3d pose = Eigen::Translation3d(1, 0, t * t * t) *
                                       Eigen::AngleAxisd(std::sin(3 * t), Vector3d::UnitZ()) *
                                       Eigen::Translation3d(-1, 0, 0);
        return Pose(pose.translation(), Eigen::Quaterniond(pose.rotation()));
    };
    own.bounds = [](double from, double to) {
        const auto largest = [&](auto f) { return std::max(std::abs(f(from)), std::abs(f(to))); };
        MotionBounds bounds;
        const double middle = 0.5 * (from + to), half = 0.5 * (to - from);
        bounds.turn_rate = std::min(3.0, 3 * std::abs(std::cos(3 * middle)) + 9 * half);
        bounds.turn_acceleration = std::min(9.0, 9 * std::abs(std::sin(3 * middle)) + 27 * half);
        bounds.speed = largest([](double t) { return 3 * t * t; });
        bounds.acceleration = largest([](double t) { return 6 * t; });
        return bounds;
    };
    own.reference = {1, 0, 0};
    return own;
}

/// The swing with one bound that is too small by a tenth.
OwnTrajectory with_wrong(double MotionBounds::*bound) {
    OwnTrajectory own = swing();
    own.bounds = [right = own.bounds, bound](double from, double to) {
        MotionBounds bounds = right(from, to);
        bounds.*bound *= 0.9;
        return bounds;
    };
    return own;
}

TEST(OwnTrajectory, BoundsThatHoldAreNotBroken) {
    for (std::uint64_t seed = 1; seed <= 5; ++seed)
        EXPECT_FALSE(find_broken_bound(swing(), 5000, seed));
}

TEST(OwnTrajectory, ABoundThatIsTooSmallByATenthIsFoundWithinASecond) {
    using Bound = double MotionBounds::*;
    const std::pair<Bound, const char*> bounds[] = {{&MotionBounds::turn_rate, "turn_rate"},
                                                    {&MotionBounds::turn_acceleration, "turn_acceleration"},
                                                    {&MotionBounds::speed, "speed"},
                                                    {&MotionBounds::acceleration, "acceleration"}};
    for (const auto& [bound, name] : bounds) {
        const auto start = std::chrono::steady_clock::now();
        const auto broken = find_broken_bound(with_wrong(bound));
        EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(1));
        ASSERT_TRUE(broken) << name;
        EXPECT_EQ(broken->bound, name);
        EXPECT_GT(broken->found, broken->stated);
        EXPECT_GE(broken->at, broken->from);
        EXPECT_LE(broken->at, broken->to);
        const MotionBounds right = swing().bounds(broken->from, broken->to);
        EXPECT_LE(broken->found, right.*bound * (1 + 1e-6)) << "what is found is a proof";
    }
}

TEST(OwnTrajectory, AWrongReferenceBreaksItsBounds) {
    OwnTrajectory own = swing();
    own.reference = {0, 0, 0};
    const auto broken = find_broken_bound(own);
    ASSERT_TRUE(broken);
    EXPECT_TRUE(broken->bound == "speed" || broken->bound == "acceleration");
}

/// An unknown acceleration bounds nothing, so nothing breaks it.
TEST(OwnTrajectory, UnknownAccelerationsAreNoBounds) {
    OwnTrajectory own = swing();
    own.bounds = [](double, double) { return MotionBounds{.turn_rate = 3, .speed = 3}; };
    EXPECT_FALSE(find_broken_bound(own));
    own.bounds = [](double, double) { return MotionBounds{.turn_rate = 3, .speed = 2.7}; };
    ASSERT_TRUE(find_broken_bound(own));
}

TEST(OwnTrajectory, KnotsSeparateVelocities) {
    OwnTrajectory corner;
    corner.pose_at = [](double t) { return Pose(Vector3d(std::abs(t - 0.5), 0, 0), Eigen::Quaterniond::Identity()); };
    corner.bounds = [](double, double) { return MotionBounds{0, 0, 1, 0}; };
    ASSERT_TRUE(find_broken_bound(corner));
    corner.knots = {0.5};
    EXPECT_FALSE(find_broken_bound(corner));
}

TEST(OwnTrajectory, WhatCannotBeUsedIsRefusedByName) {
    const auto refused = [](auto change) {
        OwnTrajectory own = swing();
        change(own);
        return refusal([&] { (void)Motion::along(own); });
    };
    EXPECT_EQ(refused([](OwnTrajectory& own) { own.pose_at = nullptr; }), "trajectory: pose_at: is missing");
    EXPECT_EQ(refused([](OwnTrajectory& own) { own.bounds = nullptr; }), "trajectory: bounds: is missing");
    EXPECT_EQ(refused([](OwnTrajectory& own) { own.knots = {0.5, 1}; }), "trajectory: knots: must be in (0, 1)");
    EXPECT_EQ(refused([](OwnTrajectory& own) { own.reference[1] = NAN; }),
              "trajectory: reference: a number is NaN or infinite");
    EXPECT_EQ(refused([](OwnTrajectory& own) {
                  own.bounds = [](double, double) { return MotionBounds{1, 1, NAN, 1}; };
              }),
              "trajectory: bounds: speed from 0 to 1: nan is no bound");
    EXPECT_EQ(refused([](OwnTrajectory& own) {
                  own.bounds = [](double, double) { return MotionBounds{-1, 1, 1, 1}; };
              }),
              "trajectory: bounds: turn_rate from 0 to 1: -1 is no bound");
    EXPECT_NE(refused([](OwnTrajectory& own) {
                  own.pose_at = [](double) { return Pose({NAN, 0, 0}, Eigen::Quaterniond::Identity()); };
              }),
              "accepted");
}

} // namespace
} // namespace chasles::test
