// The shapes of the examples.
#pragma once

#include <chasles/chasles.h>

namespace chasles::examples {

Polyhedron box(const Eigen::Vector3d& lower, const Eigen::Vector3d& upper);

/// A ball around the origin, of so many rings from pole to pole and twice as many sides.
Polyhedron ball(double radius, int rings);

/// A bolt with a hexagonal head in the plane z = 0 and a round shank along z. Lengths in any unit.
Polyhedron hexagon_bolt(double across_corners, double head, double shank_diameter, double length);

} // namespace chasles::examples
