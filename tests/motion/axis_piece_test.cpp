// Motions about or along one axis: their pieces against the poses of their frames, and exactly where they are simple.
#include "chasles/motion/axis_piece.h"

#include "chasles/motion/motion.h"
#include "chasles/motion/screw_path.h"
#include "chasles/motion/timed_poses.h"
#include "tests/support/random_poses.h"

#include <gtest/gtest.h>
#include <numbers>

namespace chasles::test {
namespace {

using algebra::ExactNumber;
using Eigen::Vector3d;
using ExactMaps = motion::ControlMaps<ExactNumber>;

std::vector<double> random_law(Random& random) {
    std::vector<double> law{random.chance(0.3) ? 0 : random.uniform(-2, 2)};
    for (int degree = random.integer(1, 3); degree > 0; --degree)
        law.push_back(random.uniform(-4, 4));
    return law;
}

Pose flat_pose(Random& random, double height) {
    const double angle = random.uniform(-2, 2);
    return {Vector3d(random.uniform(-2, 2), random.uniform(-2, 2), height), {std::cos(angle), 0, 0, std::sin(angle)}};
}

constexpr int kinds = 10;

Motion motion_of_kind(Random& random, int kind) {
    const Vector3d point = random_point(random, 2), direction = random_point(random, 2);
    const Motion rest = Motion::at_rest(random_pose(random, 2)), other = Motion::at_rest(random_pose(random, 2));
    const Motion hinge = Motion::hinge(point, direction, random_law(random));
    switch (kind) {
    case 0:
        return hinge;
    case 1:
        return rest * hinge * other;
    case 2:
        return relative(rest, hinge * other);
    case 3:
        return rest_of(rest * hinge, random.uniform(0, 0.9));
    case 4:
        return rest * Motion::slider(direction, random_law(random)) * other;
    case 5: // two links on one pin
        return relative(rest * hinge * other, rest * Motion::hinge(point, -2 * direction, random_law(random)));
    case 9:
        return motion_of_kind(random, random.integer(0, 8)).reversed();
    case 6:
        return Motion::twist(flat_pose(random, 0.3), flat_pose(random, 0.3));
    case 7: {
        const Pose start = random_pose(random, 2);
        return Motion::velocity(start, Pose(start.translation, random_pose(random, 2).rotation));
    }
    default:
        return TimedPoses::through(
            {0, 0.1, 3, 4}, {flat_pose(random, 1), flat_pose(random, 1), flat_pose(random, 1), flat_pose(random, 1)},
            TimedPoses::Between::twist);
    }
}

/// The moving body seen from the fixed one.
Eigen::Matrix4d relative_pose(const Motion& motion, double time) {
    return (motion.fixed_pose_at(time).isometry().inverse() * motion.pose_at(time).isometry()).matrix();
}

double value_at(const algebra::Bernstein<3, double>& p, double tau) {
    const double rest = 1 - tau;
    return p[0] * rest * rest * rest + 3 * tau * rest * (p[1] * rest + p[2] * tau) + p[3] * tau * tau * tau;
}

Eigen::Matrix4d pose_at(const motion::ControlMaps<double>& maps, double tau) {
    Eigen::Matrix4d pose = Eigen::Matrix4d::Identity();
    const double weight = value_at(maps.weight, tau);
    for (int i = 0; i < 3; ++i) {
        pose(i, 3) = value_at(maps.translation[i], tau) / weight;
        for (int j = 0; j < 3; ++j)
            pose(i, j) = value_at(maps.rotation.row[i][j], tau) / weight;
    }
    return pose;
}

/// The largest difference of a coefficient from the exact one, both over the first weight.
double error_of(const motion::ControlMaps<algebra::DoubleDouble>& maps, const ExactMaps& exact) {
    double error = 0;
    const auto compare = [&](const algebra::Bernstein<3, algebra::DoubleDouble>& p,
                             const algebra::Bernstein<3, ExactNumber>& q) {
        for (int i = 0; i < 4; ++i)
            error = std::max(error, std::abs(double(p[i] - motion::quotient(q[i], exact.weight[0]))));
    };
    compare(maps.weight, exact.weight);
    for (int i = 0; i < 3; ++i) {
        compare(maps.translation[i], exact.translation[i]);
        compare(maps.inverse_translation[i], exact.inverse_translation[i]);
        for (int j = 0; j < 3; ++j) {
            compare(maps.rotation.row[i][j], exact.rotation.row[i][j]);
            compare(maps.moment.row[i][j], exact.moment.row[i][j]);
        }
    }
    return error;
}

TEST(AxisPiece, FollowsTheFrameAndMeetsTheNextPiece) {
    Random random(3501);
    for (int trial = 0; trial < 40 * kinds; ++trial) {
        SCOPED_TRACE(trial % kinds);
        const Motion motion = motion_of_kind(random, trial % kinds);
        const auto pieces = motion.trajectory().pieces();
        double last = 0;
        for (std::size_t i = 0; i < pieces->size(); ++i) {
            const auto piece = pieces->at(i);
            ASSERT_FALSE(piece->enclosure({0, 1}));
            ASSERT_EQ(piece->time_of({0, 0}).lower, last);
            last = piece->time_of({1, 1}).upper;
            const auto refined = motion::control_maps(piece->cubic());
            const auto maps = motion::rounded(refined);
            ASSERT_LT(error_of(refined, piece->exact()->maps), 0x1p-96);
            for (const double tau : {0.0, 0.1, 0.5, 0.77, 1.0}) {
                const Bracket time = piece->time_of({tau, tau});
                ASSERT_LE(time.lower, time.upper);
                const Eigen::Matrix4d pose = pose_at(maps, tau);
                // Where a law turns back, a width of the value is a far greater one of time.
                const double middle = (time.lower + time.upper) / 2;
                ASSERT_LT((pose - relative_pose(motion, middle)).norm(), 1e-10) << tau;
                if (tau > 0 && tau < 1) {
                    const double step = 1e-6, rate = piece->tau_rate(tau);
                    const Bracket next = piece->time_of({tau + step, tau + step});
                    ASSERT_NEAR(step / ((next.lower + next.upper) / 2 - middle) / rate, 1, 1e-2);
                }
            }
        }
        ASSERT_EQ(last, 1);
    }
}

/// Time goes the other way than the clock of the piece: the law, evaluated at both ends of the bracket.
TEST(AxisPiece, BracketsOfTimeHoldTheTime) {
    Random random(3502);
    for (int trial = 0; trial < 300; ++trial) {
        // The angle 3 t^2 - 2 t^3 times a turn stops at both ends.
        const double turn = random.uniform(-3, 3);
        const Motion motion = Motion::hinge({0, 0, 0}, {0, 0, 1}, {0, 0, 3 * turn, -2 * turn});
        const auto pieces = motion.trajectory().pieces();
        for (std::size_t i = 0; i < pieces->size(); ++i) {
            const auto piece = pieces->at(i);
            const auto maps = motion::rounded(motion::control_maps(piece->cubic()));
            const double tau = random.uniform(0, 1);
            const Eigen::Matrix4d pose = pose_at(maps, tau);
            const double angle = std::atan2(pose(1, 0), pose(0, 0));
            const Bracket time = piece->time_of({tau, tau});
            const auto angle_at = [&](double t) { return turn * t * t * (3 - 2 * t); };
            EXPECT_LE(std::abs(angle_at(time.lower)), std::abs(angle) + 1e-15);
            EXPECT_GE(std::abs(angle_at(time.upper)), std::abs(angle) - 1e-15);
            EXPECT_NEAR(angle_at(time.upper), angle_at(time.lower), 1e-13);
        }
    }
}

bool is_zero(const algebra::Bernstein<3, ExactNumber>& p) {
    return p[0].sign() == 0 && p[1].sign() == 0 && p[2].sign() == 0 && p[3].sign() == 0;
}

/// Where the moving body's point `body` is, less `place`, times the weight.
motion::Vector3<algebra::Bernstein<3, ExactNumber>> apart(const ExactMaps& maps, const Vector3d& body,
                                                          const Vector3d& place) {
    const auto at = motion::vector_in<ExactNumber>(body), other = motion::vector_in<ExactNumber>(place);
    motion::Vector3<algebra::Bernstein<3, ExactNumber>> result;
    for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 4; ++k)
            result[i].set(k, ExactNumber(maps.rotation.row[i].x[k] * at.x + maps.rotation.row[i].y[k] * at.y +
                                         maps.rotation.row[i].z[k] * at.z + maps.translation[i][k] -
                                         maps.weight[k] * other[i]));
    return result;
}

/// Exactly, whatever the angles, which are rounded.
TEST(AxisPiece, PointsOfTheLineOfAHingeStay) {
    Random random(3503);
    for (int trial = 0; trial < 100; ++trial) {
        const Vector3d point = random_point(random, 2), direction(random.integer(-8, 8), random.integer(-8, 8), 3);
        const Vector3d beyond = Vector3d(std::round(point.x()), 2, 0.5) + direction; // without rounding
        const Vector3d on_line = beyond - direction;
        const auto pieces = Motion::hinge(on_line, direction, random_law(random)).trajectory().pieces();
        for (std::size_t i = 0; i < pieces->size(); ++i) {
            const auto exact = pieces->at(i)->exact();
            for (const Vector3d& p : {on_line, beyond})
                for (int axis = 0; axis < 3; ++axis)
                    ASSERT_TRUE(is_zero(apart(exact->maps, p, p)[axis]));
            ASSERT_FALSE(is_zero(apart(exact->maps, point, point).x)) << "others move";
        }
    }
}

/// Ends that are given are kept without rounding.
TEST(AxisPiece, ATwistInAPlaneEndsAtItsGoal) {
    Random random(3504);
    for (int trial = 0; trial < 100; ++trial) {
        const Pose start = flat_pose(random, 0.3), goal = flat_pose(random, 0.3);
        const auto pieces = Motion::twist(start, goal).trajectory().pieces();
        const auto first = pieces->at(0)->exact(), last = pieces->at(pieces->size() - 1)->exact();
        ASSERT_TRUE(first && last);
        const Vector3d origin = Vector3d::Zero();
        for (int axis = 0; axis < 3; ++axis) {
            EXPECT_EQ(apart(first->maps, origin, start.translation)[axis][0].sign(), 0);
            EXPECT_EQ(apart(last->maps, origin, goal.translation)[axis][3].sign(), 0);
        }
        const Vector3d up(random.uniform(-1, 1), random.uniform(-1, 1), 0);
        EXPECT_TRUE(is_zero(apart(last->maps, up, start.translation).z)) << "stays in its plane";
    }
}

TEST(AxisPiece, MotionsWithTwoAxesAreEnclosed) {
    Random random(3505);
    const auto is_enclosed = [](const Motion& motion) {
        return motion.trajectory().pieces()->at(0)->enclosure({0, 1}).has_value();
    };
    const Motion hinge = Motion::hinge({0, 0, 0}, {0, 0, 1}, {0, 1});
    EXPECT_FALSE(is_enclosed(hinge));
    EXPECT_FALSE(is_enclosed(hinge * Motion::hinge({0, 0, 5}, {0, 0, -3}, {1, 1, 1}))) << "on one line";
    EXPECT_TRUE(is_enclosed(hinge * Motion::hinge({0, 1, 0}, {0, 0, 1}, {0, 1})));
    EXPECT_TRUE(is_enclosed(hinge * Motion::hinge({0, 0, 0}, {0, 1e-9, 1}, {0, 1})));
    EXPECT_TRUE(is_enclosed(hinge * Motion::slider({0, 0, 1}, {0, 1}))) << "a helix";
    Motion long_product = hinge;
    for (int i = 0; i < 500; ++i)
        long_product = long_product * Motion::at_rest(random_pose(random, 1));
    EXPECT_TRUE(is_enclosed(long_product)) << "whose numbers would be long";
    EXPECT_TRUE(is_enclosed(Motion::twist(flat_pose(random, 0), flat_pose(random, 1e-9))));
    EXPECT_TRUE(is_enclosed(Motion::velocity(flat_pose(random, 0), flat_pose(random, 0))));
}

/// Its value does not change in double-double.
TEST(AxisPiece, AWayOfNothingTellsNoTimeAndNoNaN) {
    for (const std::vector<double>& law : {std::vector<double>{1, 0, 1e-60}, {1}, {1, 1e-60}, {0, 0, 1e-300}}) {
        const auto pieces = Motion::hinge({0, 0, 0}, {0, 0, 1}, law).trajectory().pieces();
        for (std::size_t i = 0; i < pieces->size(); ++i) {
            const auto piece = pieces->at(i);
            const Bracket time = piece->time_of({0.25, 0.5});
            EXPECT_LE(time.lower, 0.25 + 1e-12);
            EXPECT_GE(time.upper, 0.5 - 1e-12);
            EXPECT_TRUE(std::isfinite(piece->tau_rate(0.5)));
            EXPECT_GT(piece->tau_tolerance(1e-12), 0);
        }
    }
}

/// A law may turn back often, stop in between, and stay.
TEST(AxisPiece, LawsTurnBack) {
    const auto count = [](const std::vector<double>& law) {
        return Motion::slider({0, 0, 1}, law).trajectory().pieces()->size();
    };
    EXPECT_EQ(count({0, 1}), 1U);
    EXPECT_EQ(count({0, 1, 0, 0}), 1U);
    EXPECT_EQ(count({0, 0, 1}), 1U) << "starts without a speed";
    EXPECT_EQ(count({0, 1, -1}), 2U);
    EXPECT_EQ(count({0, 11, -33, 22}), 3U);
    EXPECT_EQ(count({0, 0.75, -1.5, 1}), 1U) << "stops in the middle, and goes on";
    EXPECT_EQ(count({0.25, 1, -4, 4}), 3U) << "turns back at 1/6 and 1/2";
    EXPECT_EQ(count({0, 0, 0, 0, 35, -84, 70, -20}), 1U) << "rests at both ends, up to the third rate";
    EXPECT_EQ(count({3}), 1U);
    EXPECT_EQ(count({0}), 1U);
}

} // namespace
} // namespace chasles::test
