// Reads meshes from files without changing them: vertices, polygons, and the line number of each polygon.
// mesh_files.cpp also defines Polyhedron::load (chasles/mesh/polyhedron.h).
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <string_view>
#include <vector>

namespace chasles::io {

/// Vertices and polygons as a file lists them. Every index is in range and every coordinate is finite.
struct PolygonSoup {
    std::vector<Eigen::Vector3d> vertices;         ///< in the length unit of the file
    std::vector<std::vector<std::uint32_t>> faces; ///< vertex indices from 0
    std::vector<std::size_t> face_lines; ///< line number of each face, from 1; empty if the format has no lines
};

/// Reads OBJ, OFF, PLY and STL in double precision, and any other extension through Assimp. Throws InvalidInput with
/// the file name, the line number if the format has lines, and the reason. No face is dropped silently. The size of the
/// file bounds the memory, for any counts in its header.
///
/// COLLADA files say which axis points upwards. `keeps_axes` takes coordinates as they are, as robots' files mean them;
/// otherwise Assimp turns them so that y points upwards.
PolygonSoup load_polygons(const std::filesystem::path& file, bool keeps_axes = false);

/// The readers of the four formats. `text` is the content of the file. They throw InvalidInput without the file name.
PolygonSoup read_obj(std::string_view text);
PolygonSoup read_off(std::string_view text);
PolygonSoup read_ply(std::string_view text);
PolygonSoup read_stl(std::string_view text);

/// Reads a file through Assimp (glTF, COLLADA, 3MF and others), in single precision like Assimp. It applies the node
/// transforms and changes nothing else. Throws InvalidInput without the file name.
PolygonSoup read_with_assimp(const std::filesystem::path& file, bool keeps_axes);

} // namespace chasles::io
