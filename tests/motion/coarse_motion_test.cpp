// A coarse motion stays within its deviation and its rounding of the true trajectory, for the same turn.
#include "chasles/motion/coarse_motion.h"

#include "chasles/motion/any_trajectory.h"
#include "tests/support/posed_motions.h"

#include <gtest/gtest.h>

namespace chasles::test {
namespace {

/// The place of a body point, in the frame of the fixed body.
Vector3<double> place_of(const motion::AnyPiece& piece, const Vector3<double>& point, double tau) {
    const auto maps = motion::control_maps(piece.cubic());
    const auto path =
        maps.rotation * Vector3<DoubleDouble>{DoubleDouble(point.x), DoubleDouble(point.y), DoubleDouble(point.z)} +
        maps.translation;
    const DoubleDouble at(tau);
    const DoubleDouble weight = value_at(maps.weight, at);
    return {double(value_at(path.x, at) / weight), double(value_at(path.y, at) / weight),
            double(value_at(path.z, at) / weight)};
}

/// The coarse tau at which a screw of `pieces` equal turns has turned as far as its piece `index` at a tau.
double coarse_tau(double angle, std::size_t pieces, std::size_t index, double tau) {
    if (pieces == 1)
        return tau;
    const double part = angle / double(pieces);
    const double turned = part * double(index) + 2 * std::atan(tau * std::tan(part / 2));
    return std::tan(turned / 2) / std::tan(angle / 2);
}

double greatest_ratio(Random& random, const Motion& motion, double angle) {
    const auto coarse = motion.trajectory().coarse();
    const auto pieces = motion.trajectory().pieces();
    const Vector3<double> point = random.vector(1);
    const double rounding = motion::coarse_rounding * (coarse->size + norm1(point)) * 0.001;
    double greatest = 0;
    for (std::size_t index = 0; index < pieces->size(); ++index)
        for (int k = 0; k <= 4; ++k) {
            const double tau = coarse_tau(angle, pieces->size(), index, k / 4.0);
            const motion::MatrixPose pose = position_at(coarse->path, tau);
            const double off =
                length(place_of(*pieces->at(index), point, k / 4.0) - (pose.rotation * point + pose.translation));
            EXPECT_LE(off, coarse->deviation + rounding);
            if (coarse->deviation > 1e3 * rounding)
                greatest = std::max(greatest, off / coarse->deviation);
        }
    return greatest;
}

TEST(CoarseMotion, AScrewStaysWithinItsDeviation) {
    Random random(2111);
    double greatest = 0;
    for (int trial = 0; trial < 2000; ++trial) {
        const double angle = random.chance(0.3) ? std::abs(random.scaled(-17, 0)) : random.uniform(0, 1.57);
        const auto [start, goal] = random_pose_pair(random, {1, angle});
        if (random.chance(0.5)) {
            greatest = std::max(greatest, greatest_ratio(random, Motion::screw(start, goal), angle));
        } else {
            const FourPoses poses = random_four_poses(random, start, goal, 1);
            const Motion motion =
                ScrewMotion::relative(poses.moving_start, poses.moving_goal, poses.fixed_start, poses.fixed_goal);
            greatest = std::max(greatest, greatest_ratio(random, motion, angle));
        }
    }
    std::cout << "at most " << greatest << " of the deviation\n";
    EXPECT_GT(greatest, 0.5);
}

TEST(CoarseMotion, ASweepHasNoDeviation) {
    Random random(2112);
    for (int trial = 0; trial < 1000; ++trial) {
        const auto [start, goal] = random_pose_pair(random, {1, random.uniform(0, 1.57)});
        const Motion motion = Motion::sweep(start, goal, eigen(random.vector(10)));
        ASSERT_TRUE(motion.trajectory().coarse());
        EXPECT_EQ(motion.trajectory().coarse()->deviation, 0);
        greatest_ratio(random, motion, 0);
    }
}

/// Next to a half turn, rounding would decide which way round the coarse motion turns.
TEST(CoarseMotion, IsEmptyForLargeTurns) {
    for (const bool sweeps : {false, true}) {
        const auto has_coarse = [&](double angle) {
            const Pose goal({1, 2, 3}, Eigen::Quaterniond(Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitX())));
            return (sweeps ? Motion::sweep({}, goal) : Motion::screw({}, goal)).trajectory().coarse().has_value();
        };
        EXPECT_TRUE(has_coarse(1.57));
        EXPECT_FALSE(has_coarse(1.58));
        EXPECT_FALSE(has_coarse(3.141592653589793));
    }
}

} // namespace
} // namespace chasles::test
