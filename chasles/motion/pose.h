// A rigid pose: where a body's own frame stands in another frame.
#pragma once

#include "chasles/base/export.h"

#include <Eigen/Geometry>

namespace chasles {

/// A rigid displacement x -> R x + translation, with R given by a quaternion.
///
/// The quaternion (qw, qx, qy, qz) may have any non-zero length. The library normalises it exactly or with the
/// error counted, never in plain double precision; two poses whose quaternions differ by a positive factor are
/// the same pose.
struct CHASLES_EXPORT Pose {
    Eigen::Vector3d translation = Eigen::Vector3d::Zero(); ///< in the mesh's unit
    /// Not aligned for vectors: the layout is the same whatever instruction set a user compiles for.
    Eigen::Quaternion<double, Eigen::DontAlign> rotation = Eigen::Quaterniond::Identity();

    /// Of a translation, in any component; as for the coordinates of meshes (docs/derivations/10-error-bounds.md).
    static constexpr double largest_length = 1e30;

    Pose() = default;

    /// Throws InvalidInput if a number is not finite, a length exceeds largest_length, or the quaternion is zero.
    Pose(const Eigen::Vector3d& translation, const Eigen::Quaterniond& rotation);

    /// From an isometry (implicit, so that Eigen users write poses as they are used to). Throws as from_matrix().
    Pose(const Eigen::Isometry3d& isometry); // NOLINT(google-explicit-constructor)

    /// From a homogeneous matrix. Its 3x3 part must be a rotation to within 1e-5 in each entry of R^T R - I, which
    /// admits matrices printed with six digits; it is projected to the nearest rotation. Throws InvalidInput if it
    /// is further off or mirrors, if the last row is not 0 0 0 1, or if a number is not finite.
    static Pose from_matrix(const Eigen::Matrix4d& matrix);

    /// The same pose as an isometry, rounded to double precision.
    [[nodiscard]] Eigen::Isometry3d isometry() const;
};

namespace motion {

/// Told at a glance to be of numbers that the constructor of Pose takes as they are. False says nothing.
bool is_ordinary(const Pose& pose);

} // namespace motion

} // namespace chasles
