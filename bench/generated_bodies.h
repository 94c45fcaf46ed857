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

} // namespace chasles::bench
