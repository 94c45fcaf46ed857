// Reads clouds of points: PLY, OBJ and OFF by their vertices, PCD, and tables of numbers.
// `load_points` (chasles/mesh/primitives.h) is defined here.
#pragma once

#include <Eigen/Core>
#include <string_view>
#include <vector>

namespace chasles::io {

/// The points in the content of a PCD file (version 0.7; data ascii or binary). Points that are not finite are places
/// where a camera saw nothing, and are left out. Throws InvalidInput without the file name. Source: the PCD file format
/// of the Point Cloud Library.
std::vector<Eigen::Vector3d> read_pcd(std::string_view bytes);

/// The points in a table: the columns x, y and z or, without names, the first three. Throws InvalidInput with the
/// line, without the file name.
std::vector<Eigen::Vector3d> read_point_table(std::string_view text);

} // namespace chasles::io
