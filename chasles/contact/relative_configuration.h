// Both bodies at one tau of a piece of motion, in the fixed body's frame and in double: the nearest points of two
// features, and whether their distance is a local minimum. Source: docs/derivations/08-contact-frame.md and
// 16-margin.md.
#pragma once

#include "chasles/contact/feature_pair.h"
#include "chasles/mesh/body.h"
#include "chasles/motion/control_maps.h"
#include "chasles/motion/matrix_pose.h"

namespace chasles::contact {

/// matrix * v with each operation rounded as written. Eigen fuses operations where the compiler may
/// (docs/decisions/0001-contraction-off.md).
inline Eigen::Vector3d product(const Eigen::Matrix3d& matrix, const Eigen::Vector3d& v) {
    Eigen::Vector3d result;
    for (int i = 0; i < 3; ++i)
        result[i] = matrix(i, 0) * v.x() + matrix(i, 1) * v.y() + matrix(i, 2) * v.z();
    return result;
}

/// A difference shorter than this part of its operands has no reliable digit, so it gives no direction.
inline constexpr double no_direction = 1e-12;

/// The points of two features that are nearest to each other.
struct NearestPoints {
    Eigen::Vector3d on_moving;
    Eigen::Vector3d on_fixed;

    [[nodiscard]] Eigen::Vector3d apart() const { return on_moving - on_fixed; }
};

/// `tau` in [0, 1] within the piece; `maps` over the whole piece. Bodies are kept by reference.
class RelativeConfiguration {
public:
    RelativeConfiguration(const Body& moving, const Body& fixed, const motion::ControlMaps<double>& maps, double tau);

    /// Takes the velocities of another configuration, times a factor.
    void take_rates(const RelativeConfiguration& other, double factor);

    [[nodiscard]] const Body& moving() const { return moving_; }
    [[nodiscard]] const Body& fixed() const { return fixed_; }

    [[nodiscard]] Eigen::Vector3d moved(const Eigen::Vector3d& body_point) const;
    [[nodiscard]] Eigen::Vector3d turned(const Eigen::Vector3d& direction) const { return product(turn_, direction); }
    [[nodiscard]] Eigen::Vector3d turned_back(const Eigen::Vector3d& direction) const {
        return product(turn_.transpose(), direction);
    }
    [[nodiscard]] Eigen::Vector3d moved_back(const Eigen::Vector3d& point) const { return turned_back(point - shift_); }
    /// Of the moving body.
    [[nodiscard]] motion::MatrixPose pose() const;
    /// The velocity of the moving body at a point, per unit of tau.
    [[nodiscard]] Eigen::Vector3d velocity_at(const Eigen::Vector3d& point) const;

    /// A vertex is nearest to its foot on the plane of a face, which need not be in the face; to a point of the rim, if
    /// the face is a line up to rounding.
    [[nodiscard]] NearestPoints nearest(const FeaturePair& features) const;

    /// The steepest descent of the distance beside the nearest points of two features: the largest cosine of the angle
    /// between the shortest connection and a direction into an adjacent face. At most 0 if the distance is a local
    /// minimum.
    [[nodiscard]] double descent(const FeaturePair& features, const NearestPoints& nearest) const;

    /// A bound of the angular velocity, radians per unit of tau.
    [[nodiscard]] double turn_rate() const { return turn_rate_.norm(); }

private:
    const Body& moving_;
    const Body& fixed_;
    Eigen::Matrix3d turn_;
    Eigen::Vector3d shift_;
    Eigen::Matrix3d turn_rate_; ///< d/dtau
    Eigen::Vector3d shift_rate_;
};

/// The point of the outline of a face that is nearest to a point; in the frame of the body.
Eigen::Vector3d nearest_of_rim(const Body& body, std::uint32_t face, const Eigen::Vector3d& point);

/// The point of a segment of some length that is nearest to a point.
Eigen::Vector3d foot_on_segment(const Eigen::Vector3d& from, const Eigen::Vector3d& to, const Eigen::Vector3d& point);

} // namespace chasles::contact
