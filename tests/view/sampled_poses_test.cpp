// The motion on the page is the motion of the query.
#include "view/sampled_poses.h"

#include "tests/query/bodies.h"
#include "tests/support/even_poses.h"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace chasles {
namespace {

constexpr double whole = std::numbers::pi;

const Pose start = test::shifted(3, 0.2, 0.3);
const Pose far_turned = test::turned({-1, 0.2, 0.3}, {0.1, 0.2, 0.3}, 2.5);

Eigen::Vector3d position(const view::PoseRow& row) {
    return {row[0], row[1], row[2]};
}

// The interpolation of the page.
Eigen::Vector3d position_at(const std::vector<view::PoseRow>& rows, double time) {
    const double place = time * static_cast<double>(rows.size() - 1);
    const auto index = std::min(static_cast<std::size_t>(place), rows.size() - 2);
    const double part = place - static_cast<double>(index);
    return position(rows[index]) * (1 - part) + position(rows[index + 1]) * part;
}

TEST(SampledPoses, BeginAndEndWhereTheMotionDoes) {
    const Motion motion = ScrewMotion::between(start, far_turned, 0.1);
    const view::SampledPoses poses = view::sampled_poses(motion);
    EXPECT_LE((position(poses.moving.front()) - start.translation).norm(), 1e-12);
    EXPECT_LE((position(poses.moving.back()) - far_turned.translation).norm(), 1e-12);
    EXPECT_EQ(poses.fixed.size(), 1U) << "the fixed body does not move";
}

TEST(SampledPoses, FollowTheScrewAsItWasCut) {
    const Polyhedron box = test::box({0.5, 0.5, 0.5}).polyhedron();
    for (const double max_turn : {0.1, 1.0, whole}) {
        const Motion motion = ScrewMotion::between(start, far_turned, max_turn);
        const FirstContact found = first_contact({.moving = box, .fixed = box, .motion = motion});
        ASSERT_EQ(found.verdict, Verdict::contact);
        const auto rows = view::sampled_poses(motion).moving;
        EXPECT_LE((position_at(rows, found.time.lower) - found.pose.translation).norm(), 4e-4) << max_turn;
    }
}

TEST(SampledPoses, TellCutsApart) {
    const auto cut = view::sampled_poses(ScrewMotion::between(start, far_turned, 0.1)).moving;
    const auto in_one = view::sampled_poses(ScrewMotion::between(start, far_turned, whole)).moving;
    EXPECT_GE((position_at(cut, 0.3) - position_at(in_one, 0.3)).norm(), 0.1);
}

TEST(SampledPoses, AreCloserWhereTheMotionIsSudden) {
    const Pose goal = test::turned({-1, 0.2, 3}, {0, 0, 1}, whole * 0.98); // nearly all of its slide is at the ends
    const ScrewMotion screw = ScrewMotion::between(start, goal, whole);
    const auto rows = view::sampled_poses(screw).moving;
    EXPECT_GT(rows.size(), view::sampled_poses(screw.with_max_turn(0.1)).moving.size());
    for (double time = 0; time < 1; time += 0.00037)
        EXPECT_LE((position_at(rows, time) - screw.pose_at(time).translation).norm(), 1e-3) << time;
}

TEST(SampledPoses, KeepToOneSideOfTheQuaternions) {
    Pose goal = far_turned;
    goal.rotation.coeffs() *= -2;
    const auto rows = view::sampled_poses(SweepMotion::between(start, goal)).moving;
    for (std::size_t i = 1; i < rows.size(); ++i) {
        double dot = 0;
        for (std::size_t k = 3; k < 7; ++k)
            dot += rows[i - 1][k] * rows[i][k];
        EXPECT_NEAR(dot, 1, 1e-3) << "a step is short, and both have length one";
    }
}

TEST(SampledPoses, HaveTheFixedBodysOwnWay) {
    const Motion motion =
        ScrewMotion::relative(start, far_turned, test::shifted(0, 0, 0), test::turned({0, 4, 0}, {0, 0, 1}, 1), 0.1);
    const view::SampledPoses poses = view::sampled_poses(motion);
    ASSERT_EQ(poses.fixed.size(), poses.moving.size());
    EXPECT_LE((position(poses.fixed.back()) - Eigen::Vector3d(0, 4, 0)).norm(), 1e-12);
    EXPECT_LE((position(poses.moving.back()) - far_turned.translation).norm(), 1e-12) << "in the world";
}

/// The greatest distance of the drawn pose from another one over dense times, for a point away from the origin.
template <class At>
double farthest(const std::vector<view::PoseRow>& rows, At at) {
    const Eigen::Vector3d point(0.5, -1, 2);
    double largest = 0;
    for (double time = 0; time < 1; time += 0.00371) {
        const auto index = static_cast<std::size_t>(time * static_cast<double>(rows.size() - 1));
        const double part = time * static_cast<double>(rows.size() - 1) - static_cast<double>(index);
        const auto turn = [&](std::size_t i) {
            return Eigen::Quaterniond(rows[i][3], rows[i][4], rows[i][5], rows[i][6]);
        };
        const Eigen::Vector3d drawn = position_at(rows, time) + turn(index).slerp(part, turn(index + 1)) * point;
        largest = std::max(largest, (drawn - at(time) * point).norm());
    }
    return largest;
}

TEST(SampledPoses, FollowTheEvenMotions) {
    const Eigen::Vector3d centre(1, -2, 0.5);
    const auto velocity = [&](double time) { return test::velocity_at(start, far_turned, centre, time); };
    const auto twist = [&](double time) { return test::twist_at(start, far_turned, time); };
    const auto by_velocity = view::sampled_poses(Motion::velocity(start, far_turned, centre)).moving;
    const auto by_twist = view::sampled_poses(Motion::twist(start, far_turned)).moving;
    EXPECT_LE(farthest(by_velocity, velocity), 1e-3);
    EXPECT_LE(farthest(by_twist, twist), 1e-3);
    EXPECT_GE(farthest(by_velocity, twist), 0.1) << "the two motions differ";
}

TEST(SampledPoses, FollowTwoBodiesThatMoveEvenly) {
    const Pose fixed_start = test::shifted(0, 0, 0), fixed_goal = test::turned({0, 4, 0}, {0.2, 0, 1}, 2);
    const Eigen::Vector3d centre(1, -2, 0.5), fixed_centre(0, 1, 3);
    const auto poses = view::sampled_poses(
        relative(Motion::velocity(start, far_turned, centre), Motion::velocity(fixed_start, fixed_goal, fixed_centre)));
    ASSERT_EQ(poses.fixed.size(), poses.moving.size());
    EXPECT_LE(farthest(poses.moving, [&](double time) { return test::velocity_at(start, far_turned, centre, time); }),
              1e-3);
    EXPECT_LE(farthest(poses.fixed,
                       [&](double time) { return test::velocity_at(fixed_start, fixed_goal, fixed_centre, time); }),
              1e-3);
}

/// The fixed body moves by time^40, and the moving body rests, exactly or up to rounding errors.
TEST(SampledPoses, AreCloserWhereTheFixedBodyMovesSuddenly) {
    std::vector<double> way(41, 0.0);
    way.back() = 3;
    const Motion sudden = Motion::slider({1, 0, 0}, way);
    for (const Motion& rest : {Motion::at_rest(start), Motion::slider({0, 1, 0}, {1, 1e-15})}) {
        const auto poses = view::sampled_poses(relative(rest, sudden));
        ASSERT_EQ(poses.fixed.size(), poses.moving.size());
        EXPECT_GT(poses.fixed.size(), 241U);
        for (double time = 0; time < 1; time += 0.00037)
            EXPECT_NEAR(position_at(poses.fixed, time).x(), 3 * std::pow(time, 40), 1e-3) << time;
    }
}

TEST(SampledPoses, AreFewWhereABodyRestsUpToRounding) {
    const Motion nearly_at_rest = Motion::polynomial({{1, 0, 0}, {1e-16, 0, 0}, {0, 1e-15, 0}, {0, 0, 1e-15}});
    const Motion fixed = Motion::twist(test::shifted(0, 0, 0), far_turned);
    EXPECT_EQ(view::sampled_poses(relative(nearly_at_rest, fixed)).moving.size(), 241U);
}

} // namespace
} // namespace chasles
