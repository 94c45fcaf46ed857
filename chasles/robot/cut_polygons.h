// What is said of meshes of robots whose polygons have no plane.
#pragma once

#include "chasles/io/mesh_files.h"
#include "chasles/mesh/polyhedron.h"

#include <optional>
#include <string>

namespace chasles::robot {

/// A line about the polygons that were cut into triangles although they leave a plane by more than what meshes may
/// elsewhere (docs/decisions/0010-polygon-planarity.md): other programs may cut them otherwise. Empty if there are
/// none.
std::optional<std::string> warning_of_cut_polygons(const io::PolygonSoup& given, const Polyhedron& made);

} // namespace chasles::robot
