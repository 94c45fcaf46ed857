// Point, normal and approach speed of a feature pair in contact.
// Source: docs/derivations/08-contact-frame.md.
#pragma once

#include "chasles/query/traversal.h"

namespace chasles::query {

/// matrix * v, each operation rounded as written: Eigen fuses them where the compiler may (docs/decisions/0001).
inline Eigen::Vector3d product(const Eigen::Matrix3d& matrix, const Eigen::Vector3d& v) {
    Eigen::Vector3d result;
    for (int i = 0; i < 3; ++i)
        result[i] = matrix(i, 0) * v.x() + matrix(i, 1) * v.y() + matrix(i, 2) * v.z();
    return result;
}

/// Describes candidates of one piece of a motion at one tau.
class ContactDetails {
public:
    /// `tau` in [0, 1] within the piece; `maps` over the whole piece; `at_start` at time 0, where what the bodies do
    /// next says nothing about the side that they touch from.
    ContactDetails(const Polyhedron& moving, const Polyhedron& fixed, const motion::ControlMaps<double>& maps,
                   double tau, bool at_start);

    /// In the frame of the fixed body; `approach_speed` is per unit of tau.
    [[nodiscard]] Contact describe(const Candidate& candidate) const;

private:
    struct Line {
        Eigen::Vector3d point;
        Eigen::Vector3d direction;
    };
    struct Place {
        Eigen::Vector3d point;
        Eigen::Vector3d normal;   ///< unit, up to its sign
        Eigen::Vector3d fallback; ///< decides the sign where nothing approaches
    };
    [[nodiscard]] Place place_of(const Candidate& candidate) const;
    [[nodiscard]] Place edge_place(const Line& moving, const Line& fixed) const;
    [[nodiscard]] Eigen::Vector3d moved(const Eigen::Vector3d& body_point) const;
    [[nodiscard]] Eigen::Vector3d velocity_at(const Eigen::Vector3d& point) const;

    const Polyhedron& moving_;
    const Polyhedron& fixed_;
    bool at_start_;
    Eigen::Matrix3d turn_;
    Eigen::Vector3d shift_;
    Eigen::Matrix3d turn_rate_; ///< d/dtau
    Eigen::Vector3d shift_rate_;
};

} // namespace chasles::query
