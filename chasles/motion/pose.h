// A rigid pose: the placement of a body's frame in another frame. Construction checks all numbers.
// Source: docs/derivations/10-error-bounds.md gives the range of numbers.
#pragma once

#include "chasles/base/export.h"

#include <Eigen/Geometry>

namespace chasles {

/// A rigid displacement x -> R x + translation, with the rotation R given by a quaternion.
///
/// The quaternion (qw, qx, qy, qz) may have any non-zero length. The library normalizes it exactly or with a counted
/// error, never in plain double precision. Two poses whose quaternions differ by a positive factor are the same pose.
struct CHASLES_EXPORT Pose {
    Eigen::Vector3d translation = Eigen::Vector3d::Zero(); ///< in the length unit of the mesh
    /// The quaternion. It is not aligned for vector instructions, therefore the
    /// layout does not depend on the instruction set that a user compiles for.
    Eigen::Quaternion<double, Eigen::DontAlign> rotation = Eigen::Quaterniond::Identity();

    /// The greatest magnitude of a component of a translation, in the length unit. It equals the limit for coordinates
    /// of meshes (docs/derivations/10-error-bounds.md).
    static constexpr double largest_length = 1e30;

    Pose() = default;

    /// From a translation (3 numbers, in the length unit) and a quaternion of any non-zero length. Throws InvalidInput
    /// if a number is not finite, a component of the translation exceeds largest_length, or the quaternion is zero.
    Pose(const Eigen::Vector3d& translation, const Eigen::Quaterniond& rotation);

    /// From an isometry. The conversion is implicit for users of Eigen. Throws InvalidInput like from_matrix().
    Pose(const Eigen::Isometry3d& isometry); // NOLINT(google-explicit-constructor)

    /// From a homogeneous 4x4 matrix. Its 3x3 part R must be a rotation up to 1e-5 in each entry of R^T R - I. This
    /// tolerance admits matrices printed with six digits. R is projected to the nearest rotation. Throws InvalidInput
    /// if R deviates more or is a reflection, if the last row is not 0 0 0 1, if a number is not finite, or if a
    /// component of the translation exceeds largest_length.
    static Pose from_matrix(const Eigen::Matrix4d& matrix);

    /// The same pose as an isometry, rounded to double.
    [[nodiscard]] Eigen::Isometry3d isometry() const;
};

namespace motion {

/// A quick test whether the constructor of Pose accepts the numbers and leaves them unchanged. False proves nothing.
bool is_ordinary(const Pose& pose);

} // namespace motion

} // namespace chasles
