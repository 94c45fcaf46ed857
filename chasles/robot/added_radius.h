// The radius of an option, added to what the shape of a file has already: spheres, capsules and clouds of points grow
// and shrink by it.
#pragma once

#include "chasles/mesh/polyhedron.h"

namespace chasles {

/// The sum of two radii, rounded up. Throws InvalidInput "radius: WHY" if the first one is above 0 and the sum is not:
/// the shape has no faces that could move inwards.
double added_radius(double of_shape, double added);

/// The shape with `added` on top of its own radius. Throws InvalidInput as added_radius and Polyhedron::with_radius.
Polyhedron with_added_radius(const Polyhedron& shape, double added);

} // namespace chasles
