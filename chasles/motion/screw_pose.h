// Poses along the screw between two poses, for reports and for cutting a screw into smaller turns.
#pragma once

#include "chasles/motion/pose.h"
#include "chasles/motion/rational_motion.h"

namespace chasles::motion {

/// The pose in another scalar, which must hold every double.
template <class S>
GeneralPose<S> pose_in(const Pose& pose) {
    const Eigen::Vector3d& t = pose.translation;
    const Eigen::Quaterniond& q = pose.rotation;
    return {{S(t.x()), S(t.y()), S(t.z())}, {S(q.w()), {S(q.x()), S(q.y()), S(q.z())}}};
}

/// The pose as double-doubles.
inline GeneralPose<algebra::DoubleDouble> exact(const Pose& pose) {
    return pose_in<algebra::DoubleDouble>(pose);
}

/// The pose rounded to double precision, with a quaternion of length one.
Pose rounded(const GeneralPose<algebra::DoubleDouble>& pose);

/// outer * inner: `inner` is given in the frame that `outer` places.
GeneralPose<algebra::DoubleDouble> composed(const GeneralPose<algebra::DoubleDouble>& outer,
                                            const GeneralPose<algebra::DoubleDouble>& inner);

/// `pose` as seen from `frame`; both are given in one frame.
GeneralPose<algebra::DoubleDouble> seen_from(const GeneralPose<algebra::DoubleDouble>& frame,
                                             const GeneralPose<algebra::DoubleDouble>& pose);

/// The angle of the turn from `start` to `goal`, in [0, pi].
double turn_angle(const GeneralPose<algebra::DoubleDouble>& start, const GeneralPose<algebra::DoubleDouble>& goal);

/// How far along a screw: as a part of its whole turn, and as a part of its whole slide, both in [0, 1].
struct ScrewProgress {
    double turned;
    double slid;
};

/// The pose on the screw from `start` to `goal`; the end poses themselves at progress {0, 0} and {1, 1}.
Pose screw_pose(const GeneralPose<algebra::DoubleDouble>& start, const GeneralPose<algebra::DoubleDouble>& goal,
                const ScrewProgress& progress);

/// A screw by its numbers, in double precision.
struct ScrewNumbers {
    double angle;
    double half_tangent; ///< of the angle; huge or infinite at a half turn
    double slide;
    Eigen::Vector3d axis_direction;
    Eigen::Vector3d axis_point;
};
ScrewNumbers screw_numbers(const GeneralPose<algebra::DoubleDouble>& start,
                           const GeneralPose<algebra::DoubleDouble>& goal);

} // namespace chasles::motion
