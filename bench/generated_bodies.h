// Closed bodies of any size, which need no data.
#pragma once

#include "chasles/mesh/polyhedron.h"

namespace chasles::bench {

/// A convex body of 20 * 4^`subdivisions` triangles with all corners on the ellipsoid of the given half-axes.
Polyhedron ellipsoid(const Eigen::Vector3d& half_axes, int subdivisions);

/// The body with every triangle cut into four coplanar triangles, repeated `times` times. All faces must be triangles.
Polyhedron subdivided(const Polyhedron& body, int times);

/// A right prism over a regular polygon about z. Its corners have the given radius, its lower face is in z = 0.
struct Prism {
    std::size_t sides;
    double radius;
    double height;
};
Polyhedron peg(const Prism& size);

/// A prism with a prismatic through hole of another radius and the same corner angles, for a peg.
Polyhedron plate_with_hole(const Prism& plate, double hole_radius);

} // namespace chasles::bench
