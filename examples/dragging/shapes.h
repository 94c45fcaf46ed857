// The shapes of the examples with hands.
#pragma once

#include <chasles/chasles.h>

#include <vector>

namespace chasles::examples {

/// A prism along z from 0 to `height` over a polygon, counter-clockwise.
Polyhedron extruded(const std::vector<Eigen::Vector2d>& outline, double height);

/// A closed outline of points (radius, z), counter-clockwise in this plane, turned about z in so many flat sides.
/// No radius is 0: there is a hole about the axis.
Polyhedron turned_ring(const std::vector<Eigen::Vector2d>& outline, int sides);

/// A round rod along z from 0 to `height`.
Polyhedron rod(double radius, double height, int sides);

} // namespace chasles::examples
