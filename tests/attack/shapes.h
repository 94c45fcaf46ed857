// Small bodies on a lattice of whole numbers, and how one is set against another so that they touch.
#pragma once

#include "tests/attack/attack_random.h"

#include <vector>

namespace chasles::attack {

using Faces = std::vector<std::vector<std::uint32_t>>;

/// Vertices and faces; every face is convex and planar on the lattice.
struct Shape {
    std::vector<Eigen::Vector3d> vertices;
    Faces faces;
};

Shape box_shape(const Eigen::Vector3d& lower, const Eigen::Vector3d& upper);

/// Triangles, tetrahedra, boxes, pyramids, fans, a notched block, dented boxes and loose triangles. Coordinates are
/// multiples of 6, so that middles and centroids are whole.
Shape random_shape(AttackRandom& random);

/// A fan of many triangles around one edge or one vertex.
Shape fan_shape(AttackRandom& random);

/// No face is without area; the reference takes no other.
bool have_area(const Shape& shape);

/// Fans of triangles instead of polygons, which rounding would bend.
void cut_into_triangles(Shape& shape);

/// Off the lattice, about a twelfth as large, in triangles.
Shape shaken(Shape shape, AttackRandom& random);

void shift(Shape& shape, const Eigen::Vector3d& by);

/// Shifts `moving` to the side `direction` of `fixed`, so that both touch one plane across it from both sides and have
/// a point of it in common: vertices, edges or faces, whatever is foremost.
void set_against(Shape& moving, const Shape& fixed, const Eigen::Vector3d& direction, AttackRandom& random);

/// The normal of some face, or a direction of the lattice.
Eigen::Vector3d some_direction(const Shape& shape, AttackRandom& random);

} // namespace chasles::attack
