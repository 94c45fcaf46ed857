// Boxes, round bodies, and polyhedra that enclose cylinders, spheres and capsules.
#pragma once

#include "chasles/mesh/polyhedron.h"

namespace chasles {

/// A polyhedron that encloses a round body, rounding included.
struct EnclosingPolyhedron {
    Polyhedron shape;
    double deviation = 0; ///< no point of the shape is farther from the body, in the length unit
};

/// The box of these three sides, centred at the origin. Throws InvalidInput "box: WHY" unless they are positive.
CHASLES_EXPORT Polyhedron make_box(const Eigen::Vector3d& sides);

/// The sphere about the origin: a point with a radius. Throws InvalidInput "sphere: WHY" unless the radius is positive.
CHASLES_EXPORT Polyhedron make_sphere(double radius);

/// All points within `radius` of the segment of this length along the z axis, whose middle is the origin. Throws
/// InvalidInput "capsule: WHY" unless both are positive.
CHASLES_EXPORT Polyhedron make_capsule(double radius, double length);

/// All points within `radius` of some points, as one body: face i is point i. Throws InvalidInput "points: WHY" unless
/// the radius is positive, and with the number of the point as from_polygons.
CHASLES_EXPORT Polyhedron make_points(std::span<const Eigen::Vector3d> points, double radius);

/// The points of a file: PLY, OBJ and OFF by their vertices, PCD (ascii or binary), and tables of numbers (.xyz, .csv
/// and .txt). Throws InvalidInput with the file, the line if the format has lines, and the reason. Defined in
/// chasles/io/point_files.cpp.
CHASLES_EXPORT Polyhedron load_points(const std::filesystem::path& file, double radius);

/// Encloses the cylinder of a radius and a length about the z axis, centred at the origin. No point of it is farther
/// than `deviation` from the cylinder, up to rounding. Throws InvalidInput "cylinder: WHY" for numbers that are not
/// positive, and for a deviation below 1e-5 of the radius.
CHASLES_EXPORT EnclosingPolyhedron enclosing_cylinder(double radius, double length, double deviation);

/// Likewise for the sphere about the origin, for deviations from 1e-3 of the radius.
CHASLES_EXPORT EnclosingPolyhedron enclosing_sphere(double radius, double deviation);

/// Likewise for the capsule: all points within `radius` of the segment of this length along the z axis.
CHASLES_EXPORT EnclosingPolyhedron enclosing_capsule(double radius, double length, double deviation);

} // namespace chasles
