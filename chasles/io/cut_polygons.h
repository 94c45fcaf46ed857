// What is said of meshes whose polygons have no plane, where they are cut into triangles.
#pragma once

#include "chasles/io/mesh_files.h"
#include "chasles/mesh/polyhedron.h"

#include <string>
#include <vector>

namespace chasles::io {

/// Adds a line if polygons of the file were cut into triangles that leave a plane by more than polygons may
/// (docs/decisions/0010-polygon-planarity.md): other programs may cut them otherwise.
void warn_of_cut_polygons(const std::filesystem::path& file, const PolygonSoup& given, const Polyhedron& made,
                          std::vector<std::string>& warnings);

} // namespace chasles::io
