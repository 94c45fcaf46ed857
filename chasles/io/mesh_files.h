// Meshes from files, as they stand there: vertices, polygons, and the line where each polygon was read.
// Polyhedron::load (chasles/mesh/polyhedron.h) is defined beside it in mesh_files.cpp.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <string_view>
#include <vector>

namespace chasles::io {

/// Vertices and polygons as a file lists them. Every index is in range and every coordinate is finite.
struct PolygonSoup {
    std::vector<Eigen::Vector3d> vertices;         ///< in the file's unit
    std::vector<std::vector<std::uint32_t>> faces; ///< vertex indices from 0
    std::vector<std::size_t> face_lines;           ///< line of each face, from 1; empty if the format has no lines
};

/// Reads OBJ, OFF, PLY and STL in full double precision, and any other extension through Assimp.
/// Throws InvalidInput that names the file, the line where there is one, and the reason. No face is lost silently, and
/// memory is bounded by the file's size whatever counts its header claims.
PolygonSoup load_polygons(const std::filesystem::path& file);

/// The readers of the four formats; `text` is the content of the file. They throw InvalidInput without its name.
PolygonSoup read_obj(std::string_view text);
PolygonSoup read_off(std::string_view text);
PolygonSoup read_ply(std::string_view text);
PolygonSoup read_stl(std::string_view text);

/// Reads what Assimp reads (glTF, COLLADA, 3MF, ...), in the single precision that Assimp has. Node transforms are
/// applied; nothing else is changed. Throws InvalidInput without the file's name.
PolygonSoup read_with_assimp(const std::filesystem::path& file);

} // namespace chasles::io
