// The basic profile of a metric screw thread: 60 degrees, cut off at the crest and at the root (ISO 68-1).
#pragma once

#include <array>

namespace chasles::scenes {

/// A corner of the profile. Along the thread each corner follows a helix.
struct ProfileCorner {
    double radius; ///< mm
    double axial;  ///< mm along the axis from the middle of a crest
};

/// The right-handed thread { r <= radius_at(z - lead(angle)) } about the z axis; lengths in millimetres.
///
/// The profile is periodic in `pitch`: a crest (width P/8), a flank, a root (width P/4), a flank. A nut has the same
/// profile with the material outside: the crest of the nut's tooth is the root of this profile.
struct MetricThread {
    double major_diameter = 16; ///< diameter at the crest
    double pitch = 2;

    [[nodiscard]] double triangle_height() const; ///< H of the uncut triangle, sqrt(3)/2 P
    [[nodiscard]] double crest_radius() const;    ///< D/2
    [[nodiscard]] double root_radius() const;     ///< D1/2, the crest less 5/8 H
    [[nodiscard]] double pitch_radius() const;    ///< D2/2, the radius at which tooth and gap have equal width

    /// The four corners of one pitch in axial order from -P/16: crest, crest, root, root.
    [[nodiscard]] std::array<ProfileCorner, 4> corners() const;

    /// The radius at an axial distance from the middle of any crest.
    [[nodiscard]] double radius_at(double axial) const;

    /// The rise of the helix over an angle in radians.
    [[nodiscard]] double lead(double angle) const;

    /// The area of any cross-section, equal to the volume per length: pi times the mean of radius_at() squared.
    [[nodiscard]] double section_area() const;
};

/// Axial change per radial change along a flank: the tangent of half the 60 degrees.
double flank_slope();

} // namespace chasles::scenes
