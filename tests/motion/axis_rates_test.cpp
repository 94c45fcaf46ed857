// Heights along an axis: how far the true motion is from the cubic one along a direction, against poses that are
// computed for themselves. Note 36.
#include "chasles/motion/any_trajectory.h"
#include "chasles/motion/control_maps.h"
#include "chasles/motion/motion.h"
#include "chasles/motion/screw_path.h"
#include "chasles/motion/timed_poses.h"
#include "tests/support/random_poses.h"

#include <gtest/gtest.h>

namespace chasles::test {
namespace {

using Eigen::Vector3d;

Vector3d in_eigen(const motion::Vector3<algebra::DoubleDouble>& v) {
    return {double(v.x), double(v.y), double(v.z)};
}

std::vector<double> random_numbers(Random& random, int count, double size) {
    std::vector<double> numbers;
    for (int i = 0; i < count; ++i)
        numbers.push_back(random.uniform(-size, size));
    return numbers;
}

/// The cubic motion at a share of its part.
Eigen::Isometry3d at(const motion::RationalMotion<double>& cubic, double share) {
    const motion::MatrixPose pose = motion::position_at(cubic, share);
    Eigen::Isometry3d result = Eigen::Isometry3d::Identity();
    for (int i = 0; i < 3; ++i) {
        result.translation()[i] = pose.translation[i];
        for (int j = 0; j < 3; ++j)
            result.linear()(i, j) = pose.rotation.row[i][j];
    }
    return result;
}

/// Turns about parallel axes, and slides in any direction.
Motion planar_motion(Random& random, const Vector3d& axis) {
    const auto hinge = [&] {
        return Motion::hinge(random_point(random, 2), axis, random_numbers(random, random.integer(2, 4), 1));
    };
    const auto slider = [&] {
        const Vector3d direction = random.chance(0.5) ? axis : axis.unitOrthogonal();
        return Motion::slider(direction, random_numbers(random, random.integer(2, 4), 1));
    };
    Motion motion = random.chance(0.5) ? hinge() * hinge() : hinge() * slider();
    if (random.chance(0.5))
        motion = motion * Motion::at_rest(random_pose(random, 1));
    if (random.chance(0.3))
        motion = relative(motion, hinge());
    return motion;
}

Motion any_motion(Random& random) {
    const Motion hinge = Motion::hinge(random_point(random, 2), random_point(random, 1), random_numbers(random, 3, 1));
    const Motion twist = Motion::twist(random_pose(random, 1), random_pose(random, 1));
    const Motion slider = Motion::slider(random_point(random, 1), random_numbers(random, 3, 1));
    return random.chance(0.3) ? relative(hinge, twist) : random.chance(0.5) ? hinge * slider * twist : twist * hinge;
}

struct Ratios {
    double greatest = 0; ///< of what was found over its bound
    double of_all = 0;   ///< the greatest bound along the axis over that of any direction
    int count = 0;       ///< of parts with an axis
};

/// Compares the cubic motion of random parts with the true poses.
void compare(const Motion& motion, Random& random, Ratios& ratios) {
    const auto pieces = motion.trajectory().pieces();
    for (std::size_t i = 0; i < pieces->size(); ++i) {
        const auto piece = pieces->at(i);
        const double lower = random.uniform(0, 1), upper = lower + (1 - lower) * std::exp(random.uniform(-5, 0));
        const auto enclosure = piece->enclosure({lower, upper});
        if (!enclosure || enclosure->bounds.along.turn == 0)
            continue;
        const Vector3d point = random_point(random, 2), axis = in_eigen(enclosure->bounds.along.axis);
        const double all = enclosure->bounds.deviation_of({{point.x(), point.y(), point.z()}, 0});
        const double along = enclosure->bounds.deviation_along_axis({{point.x(), point.y(), point.z()}, 0});
        ASSERT_LE(along, all);
        const Eigen::Matrix3d first = at(enclosure->cubic, 0).linear();
        for (int k = 0; k <= 8; ++k) {
            const double share = k / 8.0;
            const auto cubic = at(enclosure->cubic, share);
            const double tau = lower + share * (upper - lower);
            const auto truth = piece->fixed_pose_at(tau).isometry().inverse() * piece->pose_at(tau).isometry();
            const Vector3d off = cubic * point - truth * point;
            const double height = std::abs(off.dot(axis));
            const double seen = std::abs((cubic.linear().transpose() * off).dot(first.transpose() * axis));
            ASSERT_LE(std::max(height, seen), along + 1e-15) << "share " << share << " of " << all;
            ratios.greatest = std::max({ratios.greatest, height / along, seen / along});
        }
        ratios.of_all = std::max(ratios.of_all, along / (all + 1e-9));
        ++ratios.count;
    }
}

TEST(AxisRates, PlanarMotionsKeepTheHeightsOfTheirPoints) {
    Random random(3601);
    Ratios ratios;
    for (int trial = 0; trial < 300; ++trial) {
        const Vector3d axis = random.chance(0.3) ? Vector3d(Vector3d::UnitZ()) : random_point(random, 1).normalized();
        Motion motion = planar_motion(random, axis);
        compare(motion, random, ratios);
    }
    std::cout << ratios.count << " parts: at most " << ratios.greatest << " of the bound, which is at most "
              << ratios.of_all << " of that of all directions\n";
    EXPECT_GT(ratios.count, 1000);
}

TEST(AxisRates, NoMotionLeavesItsBoundAlongTheAxis) {
    Random random(3602);
    Ratios ratios;
    for (int trial = 0; trial < 300; ++trial)
        compare(any_motion(random), random, ratios);
    std::cout << ratios.count << " parts: at most " << ratios.greatest << " of the bound\n";
    EXPECT_GT(ratios.count, 1000);
    EXPECT_GT(ratios.greatest, 0.1) << "the bound is not far too large";
}

/// Without a way, no motion leaves its plane: only rounding is left.
TEST(AxisRates, WithoutASlideAlongTheAxisOnlyRoundingIsLeft) {
    Random random(3603);
    double greatest = 0;
    for (int trial = 0; trial < 100; ++trial) {
        const Vector3d axis = random_point(random, 1).normalized();
        const auto hinge = [&] { return Motion::hinge(random_point(random, 2), axis, random_numbers(random, 3, 1)); };
        const Motion motion = relative(hinge() * hinge(), hinge());
        const auto pieces = motion.trajectory().pieces();
        for (std::size_t i = 0; i < pieces->size(); ++i) {
            const auto enclosure = pieces->at(i)->enclosure({0, 1});
            ASSERT_TRUE(enclosure);
            greatest = std::max(greatest, enclosure->bounds.deviation_along_axis({{1, 1, 1}, 1}));
        }
    }
    EXPECT_LT(greatest, 1e-10);
}

/// A turn about an axis of whole numbers, by a quaternion of whole numbers.
Pose turned_about(const Vector3d& axis, double cosine, const Vector3d& place) {
    return {place, Eigen::Quaterniond(cosine, axis.x(), axis.y(), axis.z())};
}

/// Heights along the axis, times its length, are whole numbers: all ways are across it.
TEST(AxisRates, DoubleDoubleKeepsHeightsThatNeverChange) {
    Random random(3604);
    const Vector3d axis(1, 2, 2), across(2, 1, -2), other(2, -2, 1), point(3, -1, 2);
    const motion::Vector3<algebra::DoubleDouble> n{1, 2, 2}, p{3, -1, 2};
    double greatest = 0, bound = 0;
    int count = 0;
    for (int trial = 0; trial < 100; ++trial) {
        const auto pose = [&] {
            return turned_about(axis, random.integer(5, 20),
                                random.integer(-9, 9) * across + random.integer(-9, 9) * other);
        };
        const Motion track = TimedPoses::through({0, 0.25, 1}, {pose(), pose(), pose()});
        const Motion centred = Motion::velocity(pose(), pose(), {1, 0, 4});
        for (const Motion& motion : {centred, centred.reversed(), track, track.reversed()}) {
            const auto pieces = motion.trajectory().pieces();
            for (std::size_t i = 0; i < pieces->size(); ++i) {
                const auto part = pieces->at(i)->refined_enclosure({random.uniform(0, 0.5), 1});
                if (!part || part->bounds.turn == 0) // about or along one axis: not enclosed, or a slide alone
                    continue;
                ++count;
                bound = std::max(bound, 3 * part->bounds.deviation_along_axis({point, 0}));
                const auto maps = motion::control_maps(part->cubic);
                for (int k = 0; k < 4; ++k) { // each coefficient is a height, as heights do not change
                    motion::Vector3<algebra::DoubleDouble> place;
                    for (int j = 0; j < 3; ++j)
                        place[j] = (maps.rotation.row[j][0][k] * p.x + maps.rotation.row[j][1][k] * p.y +
                                    maps.rotation.row[j][2][k] * p.z + maps.translation[j][k]) /
                                   maps.weight[k];
                    const algebra::DoubleDouble off = dot(n, place) - algebra::DoubleDouble(5);
                    greatest = std::max(greatest, std::abs(double(off)));
                    ASSERT_LE(std::abs(double(off)), 3 * part->bounds.deviation_along_axis({point, 0}));
                }
            }
        }
    }
    std::cout << "at most " << greatest << " off, within " << bound << "\n";
    EXPECT_LT(bound, 1e-22);
    EXPECT_GT(count, 1000);
}

} // namespace
} // namespace chasles::test
