// Chooses the reader by the extension, and adds line numbers to what the mesh layer refuses.
#include "chasles/io/mesh_bytes.h"

#include "chasles/base/invalid_input.h"
#include "chasles/io/text_scan.h"

#include <algorithm>
#include <new>

namespace chasles::io {
namespace {

// "face 7: ..." from the mesh layer becomes "line 12: face 7: ...".
std::string with_line(const std::string& why, const PolygonSoup& soup) {
    Words words(why);
    if (words.next() != "face")
        return why;
    const std::string_view number = words.next();
    const auto face = parse_integer(number.substr(0, number.find(':')));
    const bool has_line = face && *face >= 0 && static_cast<std::size_t>(*face) < soup.face_lines.size();
    return has_line ? "line " + std::to_string(soup.face_lines[static_cast<std::size_t>(*face)]) + ": " + why : why;
}

// The part of a name from its last dot on; empty if there is none.
std::string_view extension_of(std::string_view name) {
    const std::size_t dot = name.rfind('.');
    return dot == std::string_view::npos ? std::string_view() : name.substr(dot);
}

void refuse_step(std::string_view bytes, std::string_view extension, const MeshFormats& formats) {
    constexpr std::string_view mark = "\xEF\xBB\xBF";
    std::string_view start = bytes.substr(0, 10'000); // the header of a STEP file is longer only in odd cases
    start.remove_prefix(start.starts_with(mark) ? mark.size() : 0);
    if (Words(start).next().starts_with("ISO-10303-21")) {
        const std::string_view schema = start.substr(std::min(start.find("FILE_SCHEMA"), start.size()));
        const bool is_ifc = schema.substr(0, schema.find(';')).find("IFC") != std::string_view::npos;
        throw InvalidInput(
            std::string(is_ifc ? "is an IFC file (a building model)" : "is a STEP file") +
            ", which holds curved surfaces, not polygons; export it as " + std::string(formats.for_export) +
            (is_ifc ? "" : ", or ask `chasles cad` (pip install \"chasles[cad]\"), which tessellates it with a bound"));
    }
    if (extension == ".step" || extension == ".stp")
        throw InvalidInput("is no STEP file, though its extension says so; " + std::string(formats.extensions) +
                           " are read");
}

PolygonSoup read_without_name(std::string_view bytes, std::string_view extension) {
    if (is_lfs_pointer(bytes))
        throw InvalidInput(lfs_way_out);
    refuse_other_content(bytes, lower_case(extension), formats_of_bytes);
    refuse_other_kind(lower_case(extension), formats_of_bytes);
    const Reader reader = reader_for(extension);
    if (!reader)
        refuse_extension(extension, formats_of_bytes);
    if (bytes.empty())
        throw InvalidInput("is empty");
    return with_faces(reader(bytes), formats_of_bytes);
}

// `work()`; every failure becomes InvalidInput with the name at the start of the message.
template <typename Work>
auto with_name(const std::string& name, const Work& work) {
    try {
        return work();
    } catch (const std::bad_alloc&) {
        throw InvalidInput(name + ": does not fit into memory");
    } catch (const InvalidInput& error) {
        throw InvalidInput(name + ": " + error.what());
    }
}

} // namespace

Reader reader_for(std::string_view extension) {
    const std::string lower = lower_case(std::string(extension));
    if (lower == ".obj")
        return read_obj;
    if (lower == ".off")
        return read_off;
    if (lower == ".ply")
        return read_ply;
    if (lower == ".stl")
        return read_stl;
    if (lower == ".bt" || lower == ".ot")
        return read_octomap;
    return nullptr;
}

void refuse_other_kind(std::string_view extension, const MeshFormats& formats) {
    if (extension == ".pcd" || extension == ".xyz")
        throw InvalidInput("is a cloud of points, not a mesh; " + std::string(formats.points));
    const std::string door(formats.robots);
    if (extension == ".urdf")
        throw InvalidInput("is a robot, not a mesh; " + door + " reads it");
    if (extension == ".xacro")
        throw InvalidInput("is source of a robot, not a mesh; expand it first (xacro FILE > robot.urdf), then " + door +
                           " reads it");
    if (extension == ".srdf")
        throw InvalidInput("has the pairs and groups of a robot, not a mesh; it goes with a URDF file: " +
                           std::string(formats.pairs_of_robots));
    if (extension == ".sdf")
        throw InvalidInput("is no mesh; files of SDF (SDFormat) are not read: write the robot as URDF for " + door);
    if (extension == ".xml" || extension == ".mjcf")
        throw InvalidInput("is no mesh; models of MuJoCo (MJCF) are not read: write the robot as URDF for " + door);
    if (extension == ".yaml" || extension == ".yml")
        throw InvalidInput("is no mesh; " + std::string(formats.paths_of_robots) +
                           " reads a JointTrajectory of ROS as YAML");
}

void refuse_extension(std::string_view extension, const MeshFormats& formats) {
    throw InvalidInput("no reader for the extension " + in_quotes(extension) + "; " + std::string(formats.extensions) +
                       " are read: export the mesh as " + std::string(formats.for_export));
}

namespace {

/// Whether the root element of a text of XML has this name. Declarations and comments may come before it.
bool has_root(std::string_view text, std::string_view name) {
    std::size_t begin = text.find('<');
    while (begin != std::string_view::npos && begin + 1 < text.size() &&
           (text[begin + 1] == '?' || text[begin + 1] == '!')) {
        const std::size_t end = text.find(text.substr(begin).starts_with("<!--") ? "-->" : ">", begin);
        begin = end == std::string_view::npos ? end : text.find('<', end);
    }
    if (begin == std::string_view::npos || !text.substr(begin + 1).starts_with(name))
        return false;
    const std::string_view rest = text.substr(begin + 1 + name.size());
    return rest.empty() || std::string_view(" \t\r\n/>").find(rest.front()) != std::string_view::npos;
}

} // namespace

void refuse_other_content(std::string_view bytes, std::string_view extension, const MeshFormats& formats) {
    if (extension == ".xml" && has_root(bytes, "robot"))
        throw InvalidInput("is a robot, not a mesh: name it .urdf; " + std::string(formats.robots) + " reads it");
    if (bytes.starts_with("\x1F\x8B"))
        throw InvalidInput("is compressed by gzip; unpack it first");
    if (bytes.starts_with("PK\x03\x04") && extension != ".3mf")
        throw InvalidInput(std::string("is a ZIP archive; unpack it first") +
                           (formats.has(".3mf") ? ", or name it .3mf if it is one" : ""));
    if (bytes.starts_with("glTF") && extension != ".glb" && extension != ".gltf")
        throw InvalidInput("is a binary glTF file; " +
                           (formats.has(".glb") ? "name it .glb" : "export it as " + std::string(formats.for_export)));
    refuse_step(bytes, extension, formats);
}

PolygonSoup with_faces(PolygonSoup soup, const MeshFormats& formats) {
    if (soup.faces.empty())
        throw InvalidInput("has no face; a mesh needs at least one" +
                           (soup.vertices.empty() ? "" : ". As a cloud of points, " + std::string(formats.points)));
    return soup;
}

Polyhedron make_polyhedron(const PolygonSoup& soup, const PolyhedronOptions& options) {
    try {
        return Polyhedron::from_polygons(soup.vertices, soup.faces, options);
    } catch (const InvalidInput& error) {
        throw InvalidInput(with_line(error.what(), soup));
    }
}

PolygonSoup read_polygons(std::string_view bytes, const std::string& name) {
    return with_name(name, [&] { return read_without_name(bytes, extension_of(name)); });
}

Polyhedron read_polyhedron(std::string_view bytes, const std::string& name, const PolyhedronOptions& options) {
    return with_name(name, [&] { return make_polyhedron(read_without_name(bytes, extension_of(name)), options); });
}

} // namespace chasles::io
