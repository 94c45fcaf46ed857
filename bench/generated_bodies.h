// Closed bodies of any size, for everyone who does not have the meshes.
#pragma once

#include "chasles/mesh/polyhedron.h"

namespace chasles::bench {

/// A convex body of 20 * 4^`subdivisions` triangles whose corners are on the ellipsoid with these half-axes.
Polyhedron ellipsoid(const Eigen::Vector3d& half_axes, int subdivisions);

/// Every triangle cut into four flat ones, `times` over; faces have to be triangles.
Polyhedron subdivided(const Polyhedron& body, int times);

/// A right prism over a regular polygon about z, corners on the given radius, from z = 0 up.
struct Prism {
    std::size_t sides;
    double radius;
    double height;
};
Polyhedron peg(const Prism& size);

/// What a peg goes into: a prism with a hole of another radius through it, with the same corner angles.
Polyhedron plate_with_hole(const Prism& plate, double hole_radius);

/// A spur gear about z, from z = 0 up, with a hole through it. A tooth points along x.
struct Gear {
    std::size_t teeth = 20;
    double module = 1; ///< pitch diameter over teeth
    double width = 4;
    double play = 0.2; ///< of two such gears at the pitch, which is pi times the module

    [[nodiscard]] double pitch_radius() const { return 0.5 * module * double(teeth); }
};

/// Flanks are involutes at a pressure angle of 20 degrees; chords make them thinner, never thicker.
Polyhedron gear(const Gear& size);

} // namespace chasles::bench
