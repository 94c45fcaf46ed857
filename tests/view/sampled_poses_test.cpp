// The motion on the page is the motion of the query.
#include "view/sampled_poses.h"

#include "tests/query/bodies.h"

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

} // namespace
} // namespace chasles
