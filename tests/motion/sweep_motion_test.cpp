// The sweep by its definition: a reference point moves along a line, the quaternion is interpolated linearly and
// normalised.
#include "chasles/motion/motion.h"

#include "chasles/base/invalid_input.h"
#include "chasles/motion/control_maps.h"
#include "tests/support/random_poses.h"
#include "tests/support/trajectories.h"
#include "tests/support/wide.h"

#include <limits>
#include <numbers>

namespace chasles {
namespace {

using namespace test;
using Scalar = algebra::DoubleDouble;
using WideQuaternion = Eigen::Matrix<Wide, 4, 1>; // x y z w, of length one

WideQuaternion unit(const Eigen::Quaterniond& q) {
    const WideQuaternion w = q.coeffs().cast<Wide>();
    return w / Wide(sqrt(w.dot(w)));
}

/// The position of a body point by the definition.
WideVector defined(const Pose& start, const Pose& goal, const Eigen::Vector3d& centre, const Eigen::Vector3d& point,
                   double time) {
    const WideQuaternion a = unit(start.rotation);
    WideQuaternion b = unit(goal.rotation);
    if (a.dot(b) < 0)
        b = -b;
    const WideQuaternion between = a * Wide(1 - Wide(time)) + b * Wide(time);
    const AxisAngle turn = axis_angle(between[3], between.head<3>());
    const WideVector from = WidePose(start).of(wide(centre));
    const WideVector to = WidePose(goal).of(wide(centre));
    return from + (to - from) * Wide(time) + turned(wide(point) - wide(centre), turn.axis, turn.angle);
}

WideVector carried(const SweepMotion& sweep, const Eigen::Vector3d& body_point, double tau) {
    const auto maps = motion::control_maps(cubic_of(sweep));
    const algebra::Vector3<Scalar> b{body_point.x(), body_point.y(), body_point.z()};
    const auto path = maps.rotation * b + maps.translation;
    return WideVector(wide(value_at(path.x, Scalar(tau))), wide(value_at(path.y, Scalar(tau))),
                      wide(value_at(path.z, Scalar(tau)))) /
           wide(value_at(maps.weight, Scalar(tau)));
}

TEST(SweepMotion, FollowsTheDefinition) {
    Random random(671);
    for (const double angle : {1e-14, 1e-8, 0.3, 2.0, 3.1, std::numbers::pi}) {
        for (int trial = 0; trial < 4; ++trial) {
            const Pose start = random_pose(random, 4);
            const Pose goal = random_goal(random, start, angle, 3);
            const Eigen::Vector3d centre = random_point(random, 1);
            const auto sweep = SweepMotion::between(start, goal, centre);
            const Eigen::Vector3d b = random_point(random, 2);
            for (const double tau : {0.0, 0.2, 0.7, 1.0}) {
                const WideVector truth = defined(start, goal, centre, b, tau);
                EXPECT_LT(distance(carried(sweep, b, tau), truth), 1e-26) << "angle " << angle;
                EXPECT_LT(distance(WidePose(sweep.pose_at(tau)).of(wide(b)), truth), 1e-14) << "angle " << angle;
            }
        }
    }
}

TEST(SweepMotion, HalfTurnIsRegular) {
    const Pose goal({2, 0, 0}, Eigen::Quaterniond(0, 0, 0, 1));
    const auto sweep = SweepMotion::between(Pose(), goal);
    EXPECT_NEAR(sweep.angle(), std::numbers::pi, 1e-15);
    const Pose middle = sweep.pose_at(0.5);
    EXPECT_TRUE(middle.translation.isApprox(Eigen::Vector3d(1, 0, 0), 1e-15));
    EXPECT_NEAR(middle.rotation.angularDistance(Eigen::Quaterniond::Identity()), std::numbers::pi / 2, 1e-15);
}

TEST(SweepMotion, BackwardsVisitsTheSamePoses) {
    Random random(672);
    for (int trial = 0; trial < 50; ++trial) {
        const Pose start = random_pose(random, 4);
        const Pose goal = random_goal(random, start, random.uniform(0, 3), 3);
        const Eigen::Vector3d centre = random_point(random, 1);
        const auto forward = SweepMotion::between(start, goal, centre);
        const auto backward = SweepMotion::between(goal, start, centre);
        for (const double time : {0.0, 0.1, 0.5, 0.8, 1.0})
            EXPECT_TRUE(forward.pose_at(time).isometry().isApprox(backward.pose_at(1 - time).isometry(), 1e-14));
    }
}

TEST(SweepMotion, CentreRunsStraightAndAnotherCentreGivesAnotherPath) {
    Random random(673);
    const Pose start = random_pose(random, 4);
    const Pose goal = random_goal(random, start, 2, 3);
    const Eigen::Vector3d centre(1, 2, -1);
    const auto plain = SweepMotion::between(start, goal);
    const auto moved = plain.about(centre);
    const Eigen::Vector3d from = start.isometry() * centre;
    const Eigen::Vector3d to = goal.isometry() * centre;
    EXPECT_TRUE(moved.displacement().isApprox(to - from, 1e-14));
    EXPECT_TRUE(Eigen::Vector3d(moved.pose_at(0.25).isometry() * centre).isApprox(0.75 * from + 0.25 * to, 1e-14));
    EXPECT_GT((plain.pose_at(0.25).isometry() * centre - (0.75 * from + 0.25 * to)).norm(), 0.1);
    EXPECT_TRUE(moved.pose_at(1).isometry().isApprox(plain.pose_at(1).isometry(), 1e-14));
}

TEST(SweepMotion, TauIsTime) {
    const auto sweep = SweepMotion::between(Pose(), Pose({1, 0, 0}, Eigen::Quaterniond(1, 1, 0, 0)));
    const motion::SweepPiece piece = sweep.trajectory().piece();
    for (const Bracket& whole : {piece.tau_of({0.3, 0.3}), piece.time_of({0.3, 0.3})}) {
        EXPECT_LE(whole.lower, 0.3);
        EXPECT_GE(whole.upper, 0.3);
        EXPECT_LT(whole.upper - whole.lower, 1e-15);
    }
    EXPECT_EQ(piece.tau_rate(0.3), 1);
    EXPECT_EQ(piece.tau_tolerance(1e-12), 1e-12);
    EXPECT_EQ(piece.pose_at(0.3).translation, sweep.pose_at(0.3).translation);
}

TEST(SweepMotion, CentreThatIsNotFiniteIsRefused) {
    const Eigen::Vector3d bad(0, std::numeric_limits<double>::quiet_NaN(), 0);
    EXPECT_THROW((void)SweepMotion::between(Pose(), Pose(), bad), InvalidInput);
}

/// Found by tests/fuzz/any_numbers_fuzz.cpp: contact points became NaN.
TEST(SweepMotion, CentreBeyondAnySceneIsRefused) {
    EXPECT_THROW((void)SweepMotion::between(Pose(), Pose(), Eigen::Vector3d(0, 0, -1e31)), InvalidInput);
    EXPECT_NO_THROW((void)SweepMotion::between(Pose(), Pose(), Eigen::Vector3d(0, 0, -1e30)));
}

} // namespace
} // namespace chasles
