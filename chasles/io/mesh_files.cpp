// Chooses the reader of a mesh file by its extension and adds the file name to every message.
// `Polyhedron::load` is defined here.
#include "chasles/io/mesh_files.h"

#include "chasles/base/invalid_input.h"
#include "chasles/io/read_file.h"
#include "chasles/io/text_scan.h"
#include "chasles/mesh/polyhedron.h"

#include <new>

namespace chasles {
namespace io {
namespace {

using Reader = PolygonSoup (*)(std::string_view);

// The reader for an extension; null if Assimp must read the file.
Reader reader_for(const std::string& extension) {
    if (extension == ".obj")
        return read_obj;
    if (extension == ".off")
        return read_off;
    if (extension == ".ply")
        return read_ply;
    if (extension == ".stl")
        return read_stl;
    return nullptr;
}

// Assimp reads the file again by name, because it follows references to other files. A pipe has nothing left then.
PolygonSoup read_polygons(const std::filesystem::path& file, std::string_view bytes, bool keeps_axes) {
    const Reader reader = reader_for(lower_case(file.extension().string()));
    if (!reader && !std::filesystem::is_regular_file(file))
        throw InvalidInput("is a pipe; only .obj, .off, .ply and .stl can be read from pipes with these extensions");
    PolygonSoup soup = reader ? reader(bytes) : read_with_assimp(file, keeps_axes);
    if (soup.faces.empty())
        throw InvalidInput("has no face; a mesh needs at least one");
    return soup;
}

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

// Makes the body; messages of the mesh layer get line numbers.
Polyhedron make_polyhedron(const PolygonSoup& soup, const PolyhedronOptions& options) {
    try {
        return Polyhedron::from_polygons(soup.vertices, soup.faces, options);
    } catch (const InvalidInput& error) {
        throw InvalidInput(with_line(error.what(), soup));
    }
}

// Runs `work` and turns every failure into InvalidInput with the file name at the start of the message.
template <typename Work>
auto naming_file(const std::filesystem::path& file, const Work& work) {
    try {
        return work();
    } catch (const std::bad_alloc&) {
        fail_in_file(file, "does not fit into memory");
    } catch (const InvalidInput& error) {
        fail_in_file(file, error.what());
    }
}

} // namespace

PolygonSoup load_polygons(const std::filesystem::path& file, bool keeps_axes) {
    // `read_file` adds the file name to its own messages.
    const std::string bytes = read_file(file);
    return naming_file(file, [&] { return read_polygons(file, bytes, keeps_axes); });
}

} // namespace io

Polyhedron Polyhedron::load(const std::filesystem::path& file, const PolyhedronOptions& options) {
    const io::PolygonSoup soup = io::load_polygons(file);
    return io::naming_file(file, [&] { return io::make_polyhedron(soup, options); });
}

} // namespace chasles
