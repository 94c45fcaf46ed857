// Straight travel with a normalised linear turn ("nlerp + lerp"), symmetric in time, regular at a half turn.
#pragma once

#include "chasles/motion/motion_ends.h"
#include "chasles/motion/pose.h"

namespace chasles {

/// A reference point of the body runs along a straight line while the body turns by the normalised linear
/// interpolation of quaternions. Here tau = time. Both end poses are kept exactly.
/// Source: docs/derivations/02-rational-motion.md.
class SweepMotion {
public:
    /// The motion of one body from `start` to `goal`, both in the frame of the fixed body, which is the world.
    /// `centre` is the reference point, in the moving body's frame (default its origin).
    static SweepMotion between(const Pose& start, const Pose& goal,
                               const Eigen::Vector3d& centre = Eigen::Vector3d::Zero());

    /// For two moving bodies: the sweep of the moving body as seen from the fixed one. Poses are in the world.
    static SweepMotion relative(const Pose& moving_start, const Pose& moving_goal, const Pose& fixed_start,
                                const Pose& fixed_goal);

    /// The same with another reference point, in the moving body's frame.
    [[nodiscard]] SweepMotion about(const Eigen::Vector3d& centre) const;

    [[nodiscard]] double angle() const;                 ///< turn in [0, pi], radians
    [[nodiscard]] Eigen::Vector3d displacement() const; ///< of the reference point in the fixed body's frame

    [[nodiscard]] double tau_at(double time) const { return time; }
    [[nodiscard]] double time_at(double tau) const { return tau; }
    [[nodiscard]] double tau_rate(double) const { return 1; }       ///< dtau/dtime
    [[nodiscard]] Pose pose_at(double time) const;                  ///< of the moving body in the world
    [[nodiscard]] const MotionEnds& ends() const { return frame_; } ///< the poses that the motion is made from
    [[nodiscard]] const MotionFrame& frame() const { return frame_; }

private:
    static SweepMotion from(MotionFrame frame, const Eigen::Vector3d& centre);

    MotionFrame frame_;
};

} // namespace chasles
