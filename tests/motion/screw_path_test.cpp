// Composition, relative poses and poses along a screw, in double-double.
#include "chasles/motion/screw_path.h"

#include "tests/support/random_poses.h"
#include "tests/support/wide.h"

#include <numbers>

namespace chasles::motion {
namespace {

using namespace test;

GeneralPose<algebra::DoubleDouble> random_exact(Random& random) {
    return exact(random_pose(random, 3));
}

TEST(ExactPose, IsThePoseWithoutRounding) {
    const Pose pose({0.1, 0.2, 0.3}, Eigen::Quaterniond(0.4, 0.5, 0.6, 0.7));
    const auto kept = exact(pose);
    EXPECT_EQ(double(kept.translation.y), 0.2);
    EXPECT_EQ(double(kept.rotation.w), 0.4);
    EXPECT_EQ(double(kept.rotation.v.z), 0.7);
    EXPECT_EQ(kept.rotation.v.x.low(), 0);
}

TEST(ExactPose, RoundsToAUnitQuaternion) {
    const Pose pose = rounded(exact(Pose({1, 2, 3}, Eigen::Quaterniond(2, 0, 0, 2))));
    EXPECT_NEAR(pose.rotation.norm(), 1, 1e-15);
    EXPECT_NEAR(pose.rotation.w(), std::numbers::sqrt2 / 2, 1e-16);
}

TEST(Composed, AppliesTheInnerPoseFirst) {
    Random random(681);
    for (int trial = 0; trial < 20; ++trial) {
        const auto outer = random_exact(random);
        const auto inner = random_exact(random);
        const WideVector b = wide(random_point(random, 2));
        EXPECT_LT(distance(WidePose(composed(outer, inner)).of(b), WidePose(outer).of(WidePose(inner).of(b))), 1e-28);
    }
}

TEST(SeenFrom, UndoesTheFrame) {
    Random random(682);
    for (int trial = 0; trial < 20; ++trial) {
        const auto frame = random_exact(random);
        const auto pose = random_exact(random);
        const WideVector b = wide(random_point(random, 2));
        EXPECT_LT(distance(WidePose(seen_from(frame, pose)).of(b), WidePose(frame).inverse_of(WidePose(pose).of(b))),
                  1e-28);
    }
}

TEST(TurnAngle, IsThatOfTheShortWay) {
    Random random(683);
    for (const double angle : {0.0, 1e-12, 0.4, 2.9, std::numbers::pi}) {
        const Pose start = random_pose(random, 1);
        Pose goal = random_goal(random, start, angle, 1);
        EXPECT_NEAR(turn_angle(exact(start), exact(goal)).angle, angle, 1e-15);
        goal.rotation.coeffs() *= -1;
        EXPECT_NEAR(turn_angle(exact(start), exact(goal)).angle, angle, 1e-15);
    }
}

TEST(ScrewPose, TurnAndSlideAreIndependent) {
    Random random(684);
    for (int trial = 0; trial < 20; ++trial) {
        const Pose start = random_pose(random, 3);
        const Pose goal = random_goal(random, start, random.uniform(0.1, 3.1), 3);
        const WideScrew screw{WidePose(start), WidePose(goal)};
        const WideVector b = wide(random_point(random, 2));
        const ScrewProgress progress{random.uniform(0, 1), random.uniform(0, 1)};
        const WideVector expected =
            screw.position(b, Wide(progress.turned)) +
            screw.axis() * Wide(screw.slide() * (Wide(progress.slid) - screw.tau(Wide(progress.turned))));
        const Pose pose = screw_pose(exact(start), exact(goal), progress);
        EXPECT_LT(distance(WidePose(pose).of(b), expected), 3e-14);
    }
}

TEST(ScrewPose, EndsAreTheGivenPoses) {
    Random random(685);
    const auto start = random_exact(random);
    const auto goal = random_exact(random);
    EXPECT_EQ(screw_pose(start, goal, {0, 0}).translation, rounded(start).translation);
    EXPECT_EQ(screw_pose(start, goal, {1, 1}).translation, rounded(goal).translation);
    EXPECT_EQ(screw_pose(start, goal, {1, 1}).rotation.coeffs(), rounded(goal).rotation.coeffs());
}

TEST(ScrewPose, HalfTurnPassesTheMiddle) {
    const auto goal = exact(Pose({2, 0, 6}, Eigen::Quaterniond(0, 0, 0, 1)));
    const Pose middle = screw_pose(exact(Pose()), goal, {0.5, 0.5});
    EXPECT_TRUE(middle.translation.isApprox(Eigen::Vector3d(1, -1, 3), 1e-15)) << middle.translation.transpose();
    EXPECT_NEAR(middle.rotation.angularDistance(Eigen::Quaterniond::Identity()), std::numbers::pi / 2, 1e-15);
}

TEST(ScrewPose, TurnWithoutShiftKeepsTheOrigin) {
    const auto goal = exact(Pose({0, 0, 0}, Eigen::Quaterniond(1, 2, 3, 4)));
    EXPECT_LT(screw_pose(exact(Pose()), goal, {0.3, 0.3}).translation.norm(), 1e-16);
}

} // namespace
} // namespace chasles::motion
