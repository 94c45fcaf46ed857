// Small bodies on a lattice of whole numbers, and their placement in contact with each other.
#pragma once

#include "tests/attack/attack_random.h"

#include <vector>

namespace chasles::attack {

using Faces = std::vector<std::vector<std::uint32_t>>;

/// Vertices and faces. Every face is convex, and planar on the lattice.
struct Shape {
    std::vector<Eigen::Vector3d> vertices;
    Faces faces;
};

Shape box_shape(const Eigen::Vector3d& lower, const Eigen::Vector3d& upper);

/// Triangles, tetrahedra, boxes, pyramids, fans, a notched block, dented boxes and loose triangles. Coordinates are
/// multiples of 6, which makes midpoints and centroids whole.
Shape random_shape(AttackRandom& random);

/// A fan of many triangles around one edge or one vertex.
Shape fan_shape(AttackRandom& random);

/// Whether every face has an area, as the reference requires.
bool have_area(const Shape& shape);

/// Adds faces without area: edges of the shape, wires from its vertices to points of the lattice, triangles with three
/// corners on one line, and repeated vertices. Also a face twice, or once more the other way around.
void add_segments(Shape& shape, AttackRandom& random);

/// Replaces polygons, which rounding would warp, by fans of triangles.
void cut_into_triangles(Shape& shape);

/// The shape off the lattice, scaled by about 1/12 and perturbed, in triangles.
Shape shaken(Shape shape, AttackRandom& random);

/// Cuts some faces, each at a point very near one of its corners or sides: two of the three parts, or one, are slivers.
/// May leave only these parts. Afterwards all faces are triangles.
void add_slivers(Shape& shape, AttackRandom& random);

void shift(Shape& shape, const Eigen::Vector3d& by);

/// Shifts `moving` to the side `direction` of `fixed`. Both bodies then touch one plane normal to `direction` from
/// opposite sides, and their foremost features (vertices, edges or faces) share a point of this plane.
void set_against(Shape& moving, const Shape& fixed, const Eigen::Vector3d& direction, AttackRandom& random);

/// The normal of some face, or a direction of the lattice.
Eigen::Vector3d some_direction(const Shape& shape, AttackRandom& random);

} // namespace chasles::attack
