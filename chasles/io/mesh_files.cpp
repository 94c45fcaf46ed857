// Reads mesh files and adds the file name to every message.
// `Polyhedron::load` is defined here.
#include "chasles/io/mesh_files.h"

#include "chasles/base/invalid_input.h"
#include "chasles/io/mesh_bytes.h"
#include "chasles/io/read_file.h"
#include "chasles/mesh/polyhedron.h"

#include <new>

namespace chasles {
namespace io {
namespace {

// Assimp reads the file again by name, because it follows references to other files. A pipe has nothing left then.
PolygonSoup read_polygons(const std::filesystem::path& file, std::string_view bytes, bool keeps_axes) {
    const Reader reader = reader_for(file.extension().string());
    if (!reader && !std::filesystem::is_regular_file(file))
        throw InvalidInput("is a pipe; only .obj, .off, .ply and .stl can be read from pipes with these extensions");
    return with_faces(reader ? reader(bytes) : read_with_assimp(file, keeps_axes));
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
