// Motions between a caller's poses, and the same motions in exact rationals: quaternions of any length, two moving
// bodies, pieces of long screws, sweeps about any point, and turns from zero to a half turn.
#pragma once

#include "chasles/motion/control_maps.h"
#include "chasles/motion/motion.h"
#include "chasles/motion/screw_path.h"
#include "tests/support/rational_motions.h"
#include "tests/support/trajectories.h"

#include <cstdlib>
#include <numbers>

namespace chasles::test {

using ExactPose = motion::GeneralPose<Rational>;

inline ExactPose exact(const motion::GeneralPose<DoubleDouble>& pose) {
    return {exact(pose.translation), {exact(pose.rotation.w), exact(pose.rotation.v)}};
}
inline ExactPose exact(const Pose& pose) {
    return motion::pose_in<Rational>(pose);
}

/// The square root of a positive number, to 250 bits: the only inexact number of this header.
inline Rational root(const Rational& square) {
    using Integer = boost::multiprecision::mpz_int;
    Rational scaled = square;
    int halvings = -250;
    for (; scaled > 4; ++halvings)
        scaled /= 4;
    for (; scaled < 1; --halvings)
        scaled *= 4;
    const Integer shifted = (numerator(scaled) << 500) / denominator(scaled);
    const Rational result(Integer(sqrt(shifted)));
    const Rational power(Integer(1) << std::abs(halvings));
    return halvings < 0 ? Rational(result / power) : Rational(result * power);
}

/// One motion in the form of a query, and exactly.
struct PosedMotion {
    RationalMotion<DoubleDouble> made;
    RationalMotion<Rational> exactly;
};

/// The parameters of a random motion.
struct MotionSetting {
    double size = 1;  ///< size of translations
    double angle = 0; ///< angle of the turn, before rounding
};

/// An angle from 1e-17 to the largest turn of a screw in one piece, or to a half turn for sweeps.
inline double random_angle(Random& random, bool may_be_half_turn) {
    switch (random.integer(0, 5)) {
    case 0:
        return 0;
    case 1:
        return std::abs(random.scaled(-17, -3));
    case 2:
        return std::numbers::pi / 18;
    case 3:
        return may_be_half_turn ? std::numbers::pi * (1 - std::abs(random.scaled(-17, -3)))
                                : std::numbers::pi - 2.1e-3 * random.uniform(1, 10);
    default:
        return random.uniform(0, 3);
    }
}

inline Eigen::Vector3d eigen(const Vector3<double>& v) {
    return {v.x, v.y, v.z};
}

inline Eigen::Quaterniond random_rotation(Random& random) {
    const Vector3<double> v = random.vector(1);
    Eigen::Quaterniond q(random.uniform(-1, 1), v.x, v.y, v.z);
    return Eigen::Quaterniond(q.coeffs() * (random.chance(0.3) ? std::abs(random.scaled(-250, 250)) : 1.0));
}

/// Start and goal that are turned by about `angle` from each other.
inline std::pair<Pose, Pose> random_pose_pair(Random& random, const MotionSetting& setting) {
    const double far = random.chance(0.3) ? std::abs(random.scaled(0, 9)) : 1;
    const Pose start(eigen(random.vector(setting.size * far)),
                     random.chance(0.3) ? Eigen::Quaterniond::Identity() : random_rotation(random));
    const Eigen::Quaterniond turn(Eigen::AngleAxisd(
        setting.angle, random.chance(0.3) ? Eigen::Vector3d(Eigen::Vector3d::Unit(random.integer(0, 2)))
                                          : Eigen::Vector3d(eigen(random.vector(1)).normalized())));
    const Vector3<double> shift = random.vector(setting.size * std::abs(random.scaled(-9, 1)));
    return {start, Pose(start.translation + eigen(shift), turn * Eigen::Quaterniond(start.rotation))};
}

inline PosedMotion screw_of(const ScrewMotion& screw, const ExactPose& start, const ExactPose& goal) {
    return {cubic_of(screw), motion::screw_between(start, goal)};
}

/// Inner pieces start and end at poses in doubles. The first and the last piece keep the given end poses.
inline PosedMotion random_piece(Random& random, const ScrewMotion& screw, const ExactPose& start,
                                const ExactPose& goal) {
    const std::vector<ScrewMotion> pieces = screw.with_max_turn(random.uniform(0.05, 1)).pieces();
    const auto index = static_cast<std::size_t>(random.integer(0, int(pieces.size()) - 1));
    const motion::RelativeEnds ends = relative_ends_of(pieces[index]);
    return screw_of(pieces[index], index == 0 ? start : exact(ends.start),
                    index + 1 == pieces.size() ? goal : exact(ends.goal));
}

inline PosedMotion sweep_of(const SweepMotion& sweep, const ExactPose& start, const ExactPose& goal,
                            const Eigen::Vector3d& centre) {
    motion::Quaternion<Rational> turn = motion::turn_between(start, goal);
    const Rational length = root(turn.squared_norm());
    turn = {Rational(turn.w / length), scale(turn.v, Rational(1 / length))};
    const Vector3<double> about{centre.x(), centre.y(), centre.z()};
    return {cubic_of(sweep), motion::sweep_between(start, goal, turn, exact(about))};
}

struct FourPoses {
    Pose moving_start;
    Pose moving_goal;
    Pose fixed_start;
    Pose fixed_goal;
};

/// The poses of two moving bodies. In the frame of the second body the first one moves from `start` to `goal`, up to
/// rounding.
inline FourPoses random_four_poses(Random& random, const Pose& start, const Pose& goal, double size) {
    const auto [fixed_start, fixed_goal] = random_pose_pair(random, {size, random.uniform(0, 3)});
    const auto carried = [](const Pose& frame, const Pose& pose) {
        const Eigen::Quaterniond q(frame.rotation);
        return Pose(q.normalized() * pose.translation + frame.translation, q * Eigen::Quaterniond(pose.rotation));
    };
    return {carried(fixed_start, start), carried(fixed_goal, goal), fixed_start, fixed_goal};
}

/// A screw, a piece of one, or a sweep; of one body or of two.
inline PosedMotion random_posed_motion(Random& random, double size) {
    const bool sweeps = random.chance(0.3);
    const bool both_move = random.chance(0.4);
    const auto [start, goal] = random_pose_pair(random, {size, random_angle(random, sweeps)});
    if (!both_move) {
        if (sweeps) {
            const Eigen::Vector3d centre =
                eigen(random.vector(size * (random.chance(0.3) ? std::abs(random.scaled(0, 12)) : 1)));
            return sweep_of(SweepMotion::between(start, goal, centre), exact(start), exact(goal), centre);
        }
        const ScrewMotion screw = ScrewMotion::between(start, goal);
        return random.chance(0.3) ? random_piece(random, screw, exact(start), exact(goal))
                                  : screw_of(screw, exact(start), exact(goal));
    }
    const FourPoses poses = random_four_poses(random, start, goal, size);
    const ExactPose seen_start = seen_from(exact(poses.fixed_start), exact(poses.moving_start));
    const ExactPose seen_goal = seen_from(exact(poses.fixed_goal), exact(poses.moving_goal));
    if (sweeps)
        return sweep_of(
            SweepMotion::relative(poses.moving_start, poses.moving_goal, poses.fixed_start, poses.fixed_goal),
            seen_start, seen_goal, Eigen::Vector3d::Zero());
    const ScrewMotion screw =
        ScrewMotion::relative(poses.moving_start, poses.moving_goal, poses.fixed_start, poses.fixed_goal);
    return random.chance(0.3) ? random_piece(random, screw, seen_start, seen_goal)
                              : screw_of(screw, seen_start, seen_goal);
}

/// `factor` if CHASLES_LONG=1 is set in the environment, otherwise 1.
inline int times_if_long(int factor) {
    const char* asked = std::getenv("CHASLES_LONG");
    return asked != nullptr && std::string(asked) == "1" ? factor : 1;
}

} // namespace chasles::test
