// The polygons of one <geometry> of a COLLADA file.
#pragma once

#include "chasles/io/mesh_files.h"
#include "chasles/io/scene_graph.h"
#include "chasles/io/xml_text.h"

namespace chasles::io {

/// The faces of <triangles>, <trifans>, <tristrips>, <polylist> and <polygons>, in the coordinates of the geometry.
/// Polygons stay polygons. Lines, and polygons of fewer than three corners, are left out. Throws InvalidInput for
/// polygons with holes, and for a geometry that is no mesh.
PolygonSoup read_collada_geometry(const XmlElement& geometry, SizeBudget& budget);

} // namespace chasles::io
