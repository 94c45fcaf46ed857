// The parts of an assembly in one file, as bodies with names. Defined in chasles/io/mesh_files.cpp.
#pragma once

#include "chasles/base/export.h"
#include "chasles/mesh/polyhedron.h"

#include <filesystem>
#include <string>
#include <vector>

namespace chasles {

/// A part of a file.
struct NamedPolyhedron {
    std::string name; ///< no other part of the file has this name
    Polyhedron polyhedron;
};

/// Reads each part of a file as a body, in the coordinates of the file's scene: one for each node of glTF, COLLADA or
/// 3MF that places a mesh. A file of another format has one part, with the name of the file without its extension. A
/// part has the name of its node, or of the nearest node above it with a name. If several parts have the same name,
/// the first one keeps it, and the others get "_2", "_3" and so on: numbers that give no name of the file. Throws
/// InvalidInput as `Polyhedron::load`.
CHASLES_EXPORT std::vector<NamedPolyhedron> load_parts(const std::filesystem::path& file,
                                                       const PolyhedronOptions& options = {});

} // namespace chasles
