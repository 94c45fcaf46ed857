// Poses along the screw between two poses, for reports and for cutting a screw into smaller turns.
#pragma once

#include "chasles/motion/pose.h"
#include "chasles/motion/rational_motion.h"

namespace chasles::motion {

/// In another scalar, which must hold every double.
template <class S>
Vector3<S> vector_in(const Eigen::Vector3d& v) {
    return {S(v.x()), S(v.y()), S(v.z())};
}
template <class S>
GeneralPose<S> pose_in(const Pose& pose) {
    const Eigen::Quaterniond& q = pose.rotation;
    return {vector_in<S>(pose.translation), {S(q.w()), {S(q.x()), S(q.y()), S(q.z())}}};
}

/// The pose as double-doubles.
inline GeneralPose<algebra::DoubleDouble> exact(const Pose& pose) {
    return pose_in<algebra::DoubleDouble>(pose);
}

/// Rounded to double precision.
inline Eigen::Vector3d rounded(const Vector3<algebra::DoubleDouble>& v) {
    return {v.x.high(), v.y.high(), v.z.high()};
}

/// The pose rounded to double precision, with a quaternion of length one.
Pose rounded(const GeneralPose<algebra::DoubleDouble>& pose);

/// The same bits as those of rounded(exact(pose)).
Pose normalized(const Pose& pose);

/// outer * inner: `inner` is given in the frame that `outer` places.
GeneralPose<algebra::DoubleDouble> composed(const GeneralPose<algebra::DoubleDouble>& outer,
                                            const GeneralPose<algebra::DoubleDouble>& inner);

/// The turn from one pose to another.
struct TurnAngle {
    double angle;        ///< in [0, pi]
    double half_tangent; ///< huge or infinite at a half turn
};
TurnAngle turn_angle(const GeneralPose<algebra::DoubleDouble>& start, const GeneralPose<algebra::DoubleDouble>& goal);

/// How far along a screw: as a part of its whole turn, and as a part of its whole slide, both in [0, 1].
struct ScrewProgress {
    double turned;
    double slid;
};

/// A screw by its numbers, in double precision.
struct ScrewNumbers {
    double angle;
    double half_tangent; ///< of the angle; huge or infinite at a half turn
    double slide;
    Eigen::Vector3d axis_direction;
    Eigen::Vector3d axis_point;
};

/// The screw from one pose to another, taken apart once for many poses on it.
class ScrewPath {
public:
    using Scalar = algebra::DoubleDouble;
    ScrewPath(const GeneralPose<Scalar>& start, const GeneralPose<Scalar>& goal);

    /// Between the ends, up to rounding.
    [[nodiscard]] Pose at(const ScrewProgress& progress) const;
    [[nodiscard]] ScrewNumbers numbers() const;

private:
    GeneralPose<Scalar> start_;
    Quaternion<Scalar> turn_; ///< with length one
    Scalar half_sine_;
    Vector3<Scalar> direction_; ///< unit; of the shift if nothing turns; zero if nothing moves
    Vector3<Scalar> along_;     ///< the displacement of the body's origin along the axis, and across
    Vector3<Scalar> across_;
};

/// One pose of it; the end poses themselves at progress {0, 0} and {1, 1}.
Pose screw_pose(const GeneralPose<algebra::DoubleDouble>& start, const GeneralPose<algebra::DoubleDouble>& goal,
                const ScrewProgress& progress);

} // namespace chasles::motion
