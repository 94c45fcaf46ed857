#include "chasles/motion/sweep_trajectory.h"

#include "chasles/motion/control_maps.h"
#include "chasles/motion/path_ends.h"
#include "chasles/motion/piece_clock.h"

namespace chasles::motion {

static_assert(Trajectory<SweepTrajectory>);

namespace {

using Scalar = algebra::DoubleDouble;

Quaternion<Scalar> unit_turn(const RelativeEnds& ends) {
    const Quaternion<Scalar> turn = turn_between(ends.start, ends.goal);
    const Scalar inverse = Scalar(1.0) / sqrt(turn.squared_norm());
    return {turn.w * inverse, scale(turn.v, inverse)};
}

} // namespace

SweepPiece::SweepPiece(const MotionEnds& ends, const Eigen::Vector3d& centre)
    : ends_(ends), centre_(centre), relative_(ends),
      cubic_(sweep_between(relative_.start, relative_.goal, unit_turn(relative_), vector_in<Scalar>(centre))) {}

Bracket SweepPiece::time_of(const Bracket& tau) const {
    return PieceClock().whole(tau);
}

Pose SweepPiece::pose_at(double tau) const {
    if (tau <= 0 || tau >= 1)
        return ends_.pose_at_end(tau);
    const Scalar tau_wide(tau);
    const Scalar even = Scalar(1.0) + tau_wide * (cubic_.end_cosine - Scalar(1.0));
    const Quaternion<Scalar> turn{even, scale(cubic_.axis, tau_wide)};
    // The body's origin is the body point zero: only the translation of the control maps moves it.
    const auto maps = control_maps(cubic_);
    const Scalar inverse = Scalar(1.0) / value_at(maps.weight, tau_wide);
    const Vector3<Scalar> position{value_at(maps.translation.x, tau_wide) * inverse,
                                   value_at(maps.translation.y, tau_wide) * inverse,
                                   value_at(maps.translation.z, tau_wide) * inverse};
    return ends_.in_world(rounded({position, turn * relative_.start.rotation}), tau);
}

SweepTrajectory::SweepTrajectory(const MotionEnds& ends, const Eigen::Vector3d& centre)
    : ends_(ends), centre_(checked_centre(centre)) {}

SharedTrajectory SweepTrajectory::with_goal(const Pose& goal_in_world) const {
    return std::make_shared<const ErasedTrajectory<SweepTrajectory>>(
        SweepTrajectory(ends_.with_goal(goal_in_world), centre_));
}

SharedTrajectory SweepTrajectory::reversed() const {
    return std::make_shared<const ErasedTrajectory<SweepTrajectory>>(SweepTrajectory(ends_.reversed(), centre_));
}

PathBall SweepTrajectory::ball_around_path(const Vector3<double>& point) const {
    const Vector3<double> reference = vector_in<double>(centre_);
    const PathEnds path(ends_, point);
    const Vector3<double> straight = PathEnds(ends_, reference).chord();
    const double travel = length(straight) + length(path.chord() - straight);
    return {path.middle(), travel / 2, norm1(reference) + size_of_fixed_ends(ends_)};
}

} // namespace chasles::motion
