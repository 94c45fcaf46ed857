// Both bodies at one tau of a piece of motion, in the fixed body's frame and in double: nearest points of features, and
// whether anything next to them is nearer. Source: docs/derivations/08-contact-frame.md and 16-margin.md.
#pragma once

#include "chasles/contact/feature_pair.h"
#include "chasles/mesh/body.h"
#include "chasles/motion/control_maps.h"

namespace chasles::contact {

/// matrix * v, each operation rounded as written: Eigen fuses them where the compiler may (docs/decisions/0001).
inline Eigen::Vector3d product(const Eigen::Matrix3d& matrix, const Eigen::Vector3d& v) {
    Eigen::Vector3d result;
    for (int i = 0; i < 3; ++i)
        result[i] = matrix(i, 0) * v.x() + matrix(i, 1) * v.y() + matrix(i, 2) * v.z();
    return result;
}

/// Directions shorter than this part of what they are made of have no reliable digit left.
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

    [[nodiscard]] const Body& moving() const { return moving_; }
    [[nodiscard]] const Body& fixed() const { return fixed_; }

    [[nodiscard]] Eigen::Vector3d moved(const Eigen::Vector3d& body_point) const;
    [[nodiscard]] Eigen::Vector3d turned(const Eigen::Vector3d& direction) const { return product(turn_, direction); }
    [[nodiscard]] Eigen::Vector3d turned_back(const Eigen::Vector3d& direction) const {
        return product(turn_.transpose(), direction);
    }
    [[nodiscard]] Eigen::Vector3d moved_back(const Eigen::Vector3d& point) const { return turned_back(point - shift_); }
    /// Of the moving body, per unit of tau.
    [[nodiscard]] Eigen::Vector3d velocity_at(const Eigen::Vector3d& point) const;

    [[nodiscard]] NearestPoints nearest(const FeaturePair& features) const;

    /// How much nearer the surfaces next to the nearest points of two features lead, at most: the cosine of the angle
    /// between the shortest way and a way into one of the faces there. Not above 0 where the distance is a local
    /// minimum.
    [[nodiscard]] double descent(const FeaturePair& features, const NearestPoints& nearest) const;

    /// Radians per unit of tau, or more.
    [[nodiscard]] double turn_rate() const { return turn_rate_.norm(); }

private:
    const Body& moving_;
    const Body& fixed_;
    Eigen::Matrix3d turn_;
    Eigen::Vector3d shift_;
    Eigen::Matrix3d turn_rate_; ///< d/dtau
    Eigen::Vector3d shift_rate_;
};

/// Newell's normal of the face at the size of one, where nothing underflows. Of a face so thin that it vanishes in
/// rounding, any normal of its longest diagonal.
Eigen::Vector3d face_normal(const Body& body, std::uint32_t face);

} // namespace chasles::contact
