// Poses along the screw between two poses. They are used in reports and to divide a screw into smaller rotations.
// Source: docs/derivations/01-screw-from-two-poses.md.
#pragma once

#include "chasles/motion/pose.h"
#include "chasles/motion/rational_motion.h"

namespace chasles::motion {

/// The vector in another scalar. The scalar must represent every double.
template <class S>
Vector3<S> vector_in(const Eigen::Vector3d& v) {
    return {S(v.x()), S(v.y()), S(v.z())};
}
/// The pose in another scalar. The scalar must represent every double.
template <class S>
GeneralPose<S> pose_in(const Pose& pose) {
    const Eigen::Quaterniond& q = pose.rotation;
    return {vector_in<S>(pose.translation), {S(q.w()), {S(q.x()), S(q.y()), S(q.z())}}};
}

/// The pose in double-double, without rounding.
inline GeneralPose<algebra::DoubleDouble> exact(const Pose& pose) {
    return pose_in<algebra::DoubleDouble>(pose);
}

/// The vector rounded to double.
inline Eigen::Vector3d rounded(const Vector3<algebra::DoubleDouble>& v) {
    return {v.x.high(), v.y.high(), v.z.high()};
}

/// The pose with a normalized quaternion, rounded to double.
Pose rounded(const GeneralPose<algebra::DoubleDouble>& pose);

/// The pose with a normalized quaternion. The result has the same bits as rounded(exact(pose)), but is faster.
Pose normalized(const Pose& pose);

/// The product outer * inner. `inner` is given in the frame that `outer` places.
GeneralPose<algebra::DoubleDouble> composed(const GeneralPose<algebra::DoubleDouble>& outer,
                                            const GeneralPose<algebra::DoubleDouble>& inner);

/// The angle of the rotation from one pose to another.
struct TurnAngle {
    double angle;        ///< in radians, in [0, pi]
    double half_tangent; ///< huge or infinite at a half turn; before, its arc tangent is angle / 2, bit for bit
};
/// `turn` is turn_between two poses.
TurnAngle turn_angle(const Quaternion<algebra::DoubleDouble>& turn);
inline TurnAngle turn_angle(const GeneralPose<algebra::DoubleDouble>& start,
                            const GeneralPose<algebra::DoubleDouble>& goal) {
    return turn_angle(turn_between(start, goal));
}

/// The progress along a screw: the fractions of its whole rotation and of its whole slide, both in [0, 1].
struct ScrewProgress {
    double turned;
    double slid;
};

/// The parameters of a screw, in double. The axis is in the frame of the poses.
struct ScrewNumbers {
    double angle;        ///< in radians, in [0, pi]
    double half_tangent; ///< tangent of half the angle; huge or infinite at a half turn
    double slide;        ///< along the axis, in the length unit
    Eigen::Vector3d axis_direction;
    Eigen::Vector3d axis_point;
};

/// The screw from one pose to another, decomposed once for many poses on the screw.
class ScrewPath {
public:
    using Scalar = algebra::DoubleDouble;
    ScrewPath(const GeneralPose<Scalar>& start, const GeneralPose<Scalar>& goal)
        : ScrewPath(start, goal, turn_between(start, goal)) {}
    /// `turn` is turn_between(start, goal).
    ScrewPath(const GeneralPose<Scalar>& start, const GeneralPose<Scalar>& goal, const Quaternion<Scalar>& turn);

    /// The pose at a progress, up to rounding.
    [[nodiscard]] Pose at(const ScrewProgress& progress) const;
    [[nodiscard]] ScrewNumbers numbers() const;

private:
    GeneralPose<Scalar> start_;
    Quaternion<Scalar> turn_;   ///< of unit length
    Scalar half_sine_;          ///< sine of half the angle
    double half_angle_;         ///< in radians
    Vector3<Scalar> direction_; ///< unit; along the displacement if the angle is 0; zero if the poses are equal
    Vector3<Scalar> along_;     ///< displacement of the body's origin along the axis
    Vector3<Scalar> across_;    ///< displacement of the body's origin perpendicular to the axis
};

/// One pose of the screw. Progress {0, 0} and {1, 1} give exactly the end poses, rounded.
Pose screw_pose(const GeneralPose<algebra::DoubleDouble>& start, const GeneralPose<algebra::DoubleDouble>& goal,
                const ScrewProgress& progress);

} // namespace chasles::motion
