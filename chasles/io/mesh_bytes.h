// Meshes from the content of a file, without the file: where there is no file system, and for files that were read
// already.
#pragma once

#include "chasles/io/mesh_files.h"
#include "chasles/mesh/polyhedron.h"

#include <string>
#include <string_view>

namespace chasles::io {

/// A reader of one format.
using Reader = PolygonSoup (*)(std::string_view);

/// The reader for the extension of a format with one mesh, for example ".obj", in capitals or not; null for others.
Reader reader_for(std::string_view extension);

/// What an entry point reads, in words for messages.
struct MeshFormats {
    std::string_view extensions;      ///< all of them, for a sentence
    std::string_view for_export;      ///< those that other programs write
    std::string_view points;          ///< way out for a cloud of points
    std::string_view robots;          ///< what reads robots, for a sentence
    std::string_view pairs_of_robots; ///< what reads SRDF files
    std::string_view paths_of_robots; ///< what reads their motions

    [[nodiscard]] bool has(std::string_view extension) const {
        return extensions.find(extension) != std::string_view::npos;
    }
};
inline constexpr std::string_view in_other_packages = "the command line or the Python package of Chasles";
/// Of the npm package, which has no files and no robots.
inline constexpr MeshFormats formats_of_bytes{".obj, .off, .ply, .stl, .bt and .ot",
                                              "OBJ, OFF, PLY or STL",
                                              "chasles.points(points, radius) makes a body of its numbers",
                                              in_other_packages,
                                              in_other_packages,
                                              in_other_packages};
inline constexpr MeshFormats formats_of_files{
    ".obj, .off, .ply, .stl, .gltf, .glb, .dae, .3mf, .bt and .ot",
    "glTF, 3MF, STL or OBJ",
    "the key \"points\" of a scene file or, in Python, load_points reads it",
    "`chasles robot` or, in Python, `Robot.load`",
    "chasles robot ROBOT.urdf --srdf FILE or, in Python, Robot.load(urdf, srdf)",
    "`chasles robot ROBOT.urdf --path FILE`"};

/// Throws InvalidInput for an extension of files of robots and of clouds of points (in small letters), and says what
/// reads them.
void refuse_other_kind(std::string_view extension, const MeshFormats& formats = formats_of_files);

/// Throws InvalidInput for an extension without a reader.
[[noreturn]] void refuse_extension(std::string_view extension, const MeshFormats& formats);

/// Throws InvalidInput for files that their first bytes say to be of another format than their extension (in small
/// letters): archives, binary glTF, STEP, IFC and URDF in .xml; also for the extensions of STEP. The way out leads to a
/// format of `formats`.
void refuse_other_content(std::string_view bytes, std::string_view extension,
                          const MeshFormats& formats = formats_of_files);

/// The same mesh. Throws InvalidInput if it has no face, and says what reads points.
PolygonSoup with_faces(PolygonSoup soup, const MeshFormats& formats = formats_of_files);

/// Makes the body; messages of the mesh layer get line numbers.
Polyhedron make_polyhedron(const PolygonSoup& soup, const PolyhedronOptions& options);

/// The mesh in the content of an OBJ, OFF, PLY, STL or OctoMap file. The extension of `name` chooses the format; there
/// need be no file of this name. Throws InvalidInput with the name, the line number if the format has lines, and the
/// reason.
PolygonSoup read_polygons(std::string_view bytes, const std::string& name);

/// A body of it.
Polyhedron read_polyhedron(std::string_view bytes, const std::string& name, const PolyhedronOptions& options = {});

} // namespace chasles::io
