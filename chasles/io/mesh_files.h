// Reads meshes from files without changing them: vertices, polygons, and the line number of each polygon.
// mesh_files.cpp also defines Polyhedron::load (chasles/mesh/polyhedron.h) and load_parts
// (chasles/mesh/polyhedron_parts.h).
#pragma once

#include "chasles/mesh/polyhedron.h"

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace chasles::io {

/// Vertices and polygons as a file lists them. Every index is in range and every coordinate is finite.
struct PolygonSoup {
    std::vector<Eigen::Vector3d> vertices;         ///< in the length unit of the file
    std::vector<std::vector<std::uint32_t>> faces; ///< vertex indices from 0
    std::vector<std::size_t> face_lines; ///< line number of each face, from 1; empty if the format has no lines
};

/// The polygons of one node of a file, in the coordinates of the file's scene.
struct MeshPart {
    std::string name; ///< no other part of the file has this name
    PolygonSoup polygons;
    std::string unit = {}; ///< of the coordinates, as "meter" or "inch"; empty if the format states none
};

/// Reads OBJ, OFF, PLY, STL, OctoMap, glTF, COLLADA and 3MF in double precision (docs/files.md). Throws InvalidInput
/// with the file name, the line number if the format has lines, and the reason. No face is dropped silently. The size
/// of the file bounds the memory, for any counts in its header.
PolygonSoup load_polygons(const std::filesystem::path& file);

/// The parts of a file: one for each node that places a mesh, in glTF, COLLADA and 3MF. A file of another format is one
/// part, with the name of the file without its extension.
std::vector<MeshPart> load_mesh_parts(const std::filesystem::path& file);

/// All parts as one mesh, in order.
PolygonSoup merged(std::vector<MeshPart> parts);

/// The body of a mesh that was read from this file. Messages begin with the name of the file.
Polyhedron body_of(const std::filesystem::path& file, const PolygonSoup& mesh, const PolyhedronOptions& options);

/// The body of a part. Messages name the part, too.
Polyhedron body_of(const std::filesystem::path& file, const MeshPart& part, const PolyhedronOptions& options);

/// The readers of the formats with one mesh. `text` is the content of the file. They throw InvalidInput without the
/// file name.
PolygonSoup read_obj(std::string_view text);
PolygonSoup read_off(std::string_view text);
PolygonSoup read_ply(std::string_view text);
PolygonSoup read_stl(std::string_view text);
PolygonSoup read_octomap(std::string_view bytes);

/// Reads a file that another file refers to by this name.
using FileBeside = std::function<std::string(const std::string& name)>;

/// The readers of the formats with nodes. `file_beside` is empty where there are no other files.
std::vector<MeshPart> read_gltf(std::string_view bytes, const FileBeside& file_beside = {});
std::vector<MeshPart> read_collada(std::string_view text);
std::vector<MeshPart> read_3mf(std::string_view bytes);

} // namespace chasles::io
