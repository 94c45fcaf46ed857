// The paper's motion against sines and cosines with a hundred digits: angle w t, slide s tan(w t / 2) / tan(w / 2).
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

using std::numbers::pi;

/// The position of a body point by the control maps in double-double.
WideVector carried(const ScrewMotion& screw, const Eigen::Vector3d& body_point, double tau) {
    const auto maps = motion::control_maps(cubic_of(screw));
    const algebra::Vector3<Scalar> b{body_point.x(), body_point.y(), body_point.z()};
    const auto path = maps.rotation * b + maps.translation;
    const Wide weight = wide(value_at(maps.weight, Scalar(tau)));
    return WideVector(wide(value_at(path.x, Scalar(tau))), wide(value_at(path.y, Scalar(tau))),
                      wide(value_at(path.z, Scalar(tau)))) /
           weight;
}

WideScrew by_definition(const ScrewMotion& screw) {
    return {WidePose(relative_ends_of(screw).start), WidePose(relative_ends_of(screw).goal)};
}

/// The position at the time that belongs to the given tau.
WideVector defined(const WideScrew& screw, const Eigen::Vector3d& body_point, double tau) {
    const Wide half = screw.angle() / 2;
    const Wide time = atan(Wide(Wide(tau) * tan(half))) / half;
    return screw.position(wide(body_point), time);
}

TEST(ScrewMotion, ControlMapsFollowTheDefinition) {
    Random random(641);
    for (const double angle : {1e-14, 1e-8, 1e-3, 0.17, 1.0, 2.0, 3.0, 3.139}) {
        for (int trial = 0; trial < 4; ++trial) {
            const Pose start = random_pose(random, 5);
            const auto screw = ScrewMotion::between(start, random_goal(random, start, angle, 3));
            const WideScrew definition = by_definition(screw);
            const Eigen::Vector3d b = random_point(random, 2);
            for (const double tau : {0.0, 0.125, 0.6, 1.0})
                EXPECT_LT(distance(carried(screw, b, tau), defined(definition, b, tau)),
                          1e-25 / (pi - angle) / (pi - angle))
                    << "angle " << angle << " tau " << tau;
        }
    }
}

TEST(ScrewMotion, PosesFollowTheDefinition) {
    Random random(642);
    for (const double angle : {1e-8, 1e-3, 0.17, 1.0, 3.0, 3.139}) {
        const Pose start = random_pose(random, 5);
        const auto screw = ScrewMotion::between(start, random_goal(random, start, angle, 3));
        const WideScrew definition = by_definition(screw);
        const Eigen::Vector3d b = random_point(random, 2);
        for (const double time : {0.0, 0.3, 0.9, 1.0})
            EXPECT_LT(distance(WidePose(screw.pose_at(time)).of(wide(b)), definition.position(wide(b), time)),
                      1e-14 / (pi - angle))
                << "angle " << angle << " time " << time;
    }
}

TEST(ScrewMotion, NumbersAreThoseOfTheScrew) {
    Random random(643);
    for (int trial = 0; trial < 20; ++trial) {
        const Pose start = random_pose(random, 5);
        const auto screw = ScrewMotion::between(start, random_goal(random, start, random.uniform(0.01, 3.1), 3));
        const WideScrew definition = by_definition(screw);
        EXPECT_NEAR(screw.angle(), static_cast<double>(definition.angle()), 1e-15);
        EXPECT_NEAR(screw.slide(), static_cast<double>(definition.slide()), 1e-14);
        EXPECT_LT(distance(wide(screw.axis_direction()), definition.axis()), 1e-15);
        const WideVector off = wide(screw.axis_point()) - definition.point();
        EXPECT_LT(distance(off, definition.axis() * Wide(definition.axis().dot(off))), 1e-14 * (1 + 1 / screw.angle()));
        const Eigen::Vector3d arm = screw.axis_point() - start.translation;
        EXPECT_NEAR(arm.dot(screw.axis_direction()), 0, 1e-14 * (1 + arm.norm())) << "not the nearest axis point";
    }
}

TEST(ScrewMotion, EndPosesAreKeptToTheLastBit) {
    Random random(644);
    for (int trial = 0; trial < 50; ++trial) {
        const Pose start = random_pose(random, 5);
        const Pose goal = random_pose(random, 5);
        const auto screw = ScrewMotion::between(start, goal);
        EXPECT_EQ(screw.pose_at(0).translation, start.translation);
        EXPECT_EQ(screw.pose_at(1).translation, goal.translation);
        EXPECT_LT(screw.pose_at(0).rotation.angularDistance(start.rotation.normalized()), 1e-15);
        EXPECT_LT(screw.pose_at(1).rotation.angularDistance(goal.rotation.normalized()), 1e-15);
    }
}

TEST(ScrewMotion, VanishingTurnsTendToTheTranslation) {
    const Eigen::Vector3d shift(1, 2, 3);
    const Eigen::Vector3d b(4, -5, 6);
    const auto straight = ScrewMotion::between(Pose(), Pose(shift, Eigen::Quaterniond::Identity()));
    for (const double half : {1e-300, 1e-160, 1e-20, 1e-14, 1e-8}) {
        const Eigen::Quaterniond turn(1, 0.48 * half, 0.6 * half, 0.64 * half);
        const auto screw = ScrewMotion::between(Pose(), Pose(shift, turn));
        for (const double tau : {0.0, 0.3, 1.0}) {
            EXPECT_LT(distance(carried(screw, b, tau), carried(straight, b, tau)), 1e-15 + 100 * half) << half;
            EXPECT_EQ(screw.tau_at(tau), tau);
            EXPECT_TRUE(screw.pose_at(tau).isometry().isApprox(straight.pose_at(tau).isometry(), 1e-15 + 100 * half));
        }
    }
}

TEST(ScrewMotion, TranslationHasItsTravelAsAxis) {
    const auto straight = ScrewMotion::between(Pose(), Pose({0, 3, 4}, Eigen::Quaterniond::Identity()));
    EXPECT_EQ(straight.angle(), 0);
    EXPECT_EQ(straight.slide(), 5);
    EXPECT_TRUE(straight.axis_direction().isApprox(Eigen::Vector3d(0, 0.6, 0.8), 1e-15));
    EXPECT_EQ(ScrewMotion::between(Pose(), Pose()).axis_direction(), Eigen::Vector3d(0, 0, 1));
}

TEST(ScrewMotion, TauIsThePapersFunctionOfTime) {
    Random random(645);
    for (const double angle : {1e-12, 1e-6, 0.5, 2.0, 3.1}) {
        const Pose start = random_pose(random, 1);
        const auto screw = ScrewMotion::between(start, random_goal(random, start, angle, 1));
        for (const double time : {0.1, 0.25, 0.5, 0.99}) {
            const Wide half = Wide(screw.angle()) / 2;
            const double expected = static_cast<double>(Wide(tan(Wide(half * time)) / tan(half)));
            EXPECT_NEAR(screw.tau_at(time), expected, 3e-15 / (pi - angle) * expected);
        }
    }
}

TEST(ScrewMotion, TauAndTimeAreInverse) {
    Random random(646);
    for (const double angle : {0.0, 1e-300, 1e-12, 1e-9, 1e-4, 0.5, 2.0, 3.1}) {
        const Pose start = random_pose(random, 1);
        const auto screw = ScrewMotion::between(start, random_goal(random, start, angle, 1));
        EXPECT_EQ(screw.tau_at(0), 0);
        EXPECT_EQ(screw.tau_at(1), 1);
        EXPECT_EQ(screw.time_at(0), 0);
        EXPECT_NEAR(screw.time_at(1), 1, 1e-15);
        for (int i = 1; i < 10; ++i) {
            EXPECT_NEAR(screw.time_at(screw.tau_at(i / 10.0)), i / 10.0, 1e-14);
            EXPECT_NEAR(screw.tau_at(screw.time_at(i / 10.0)), i / 10.0, 1e-14);
        }
    }
}

TEST(ScrewMotion, QuaternionsOfAnyPositiveLengthGiveTheSameMotion) {
    const Eigen::Quaterniond q(0.9, 0.1, -0.3, 0.2);
    const auto plain = ScrewMotion::between(Pose(), Pose({1, 2, 3}, q));
    for (const double factor : {1e-200, 0.25, 3.0, 1e200}) {
        const auto scaled = ScrewMotion::between(Pose(), Pose({1, 2, 3}, Eigen::Quaterniond(q.coeffs() * factor)));
        EXPECT_NEAR(scaled.angle(), plain.angle(), 1e-15);
        EXPECT_LT(distance(carried(scaled, {4, 5, 6}, 0.4), carried(plain, {4, 5, 6}, 0.4)), 1e-14);
    }
}

TEST(ScrewMotionPoses, AHalfTurnIsItsTwoHalves) {
    const Pose start, goal({0, 0, 1}, Eigen::Quaterniond(0, 0, 0, 1));
    const ScrewMotion screw = ScrewMotion::between(start, goal, std::numbers::pi);
    double last = 0;
    for (const double time : {0.0, 0.01, 0.25, 0.5, 0.75, 0.99, 1.0}) {
        const Pose pose = screw.pose_at(time);
        const Eigen::Quaterniond turn = pose.rotation.normalized();
        EXPECT_NEAR(2 * std::atan2(turn.z(), turn.w()), time * std::numbers::pi, 1e-14);
        EXPECT_GE(pose.translation.z(), last);
        last = pose.translation.z();
        EXPECT_NEAR((pose.translation - Motion(screw).pose_at(time).translation).norm(), 0, 1e-15)
            << "along its pieces";
    }
    EXPECT_NEAR(screw.pose_at(0.5).translation.z(), 0.5, 1e-15);
}

} // namespace
} // namespace chasles
