// Reads mesh files and adds the file name to every message.
// `Polyhedron::load` and `load_parts` are defined here.
#include "chasles/io/mesh_files.h"

#include "chasles/base/invalid_input.h"
#include "chasles/io/mesh_bytes.h"
#include "chasles/io/read_file.h"
#include "chasles/io/text_scan.h"
#include "chasles/mesh/polyhedron.h"
#include "chasles/mesh/polyhedron_parts.h"

#include <new>

namespace chasles {
namespace io {
namespace {

// The parts in the content of a file; empty for formats without parts.
std::vector<MeshPart> read_parts(const std::filesystem::path& file, std::string_view bytes) {
    const std::string extension = lower_case(file.extension().string());
    refuse_other_content(bytes, extension);
    refuse_other_kind(extension);
    if (const Reader reader = reader_for(extension))
        return {{one_line(valid_utf8(file.stem().string())), with_faces(reader(bytes))}};
    const auto file_beside = [&](const std::string& name) { return read_file(file.parent_path() / name); };
    std::vector<MeshPart> parts;
    if (extension == ".gltf" || extension == ".glb")
        parts = read_gltf(bytes, file_beside);
    else if (extension == ".dae")
        parts = read_collada(bytes);
    else if (extension == ".3mf")
        parts = read_3mf(bytes);
    else
        refuse_extension(extension, formats_of_files);
    if (parts.empty())
        throw InvalidInput("has no face; a mesh needs at least one");
    return parts;
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

std::vector<MeshPart> load_mesh_parts(const std::filesystem::path& file) {
    // `read_file` adds the file name to its own messages.
    const std::string bytes = read_file(file);
    return naming_file(file, [&] { return read_parts(file, bytes); });
}

PolygonSoup load_polygons(const std::filesystem::path& file) {
    return merged(load_mesh_parts(file));
}

Polyhedron body_of(const std::filesystem::path& file, const PolygonSoup& mesh, const PolyhedronOptions& options) {
    return naming_file(file, [&] { return make_polyhedron(mesh, options); });
}

Polyhedron body_of(const std::filesystem::path& file, const MeshPart& part, const PolyhedronOptions& options) {
    return naming_file(file, [&] {
        try {
            return make_polyhedron(part.polygons, options);
        } catch (const InvalidInput& error) {
            throw InvalidInput("part " + in_quotes(part.name) + ": " + error.what());
        }
    });
}

} // namespace io

Polyhedron Polyhedron::load(const std::filesystem::path& file, const PolyhedronOptions& options) {
    return io::body_of(file, io::load_polygons(file), options);
}

std::vector<NamedPolyhedron> load_parts(const std::filesystem::path& file, const PolyhedronOptions& options) {
    std::vector<NamedPolyhedron> bodies;
    for (const io::MeshPart& part : io::load_mesh_parts(file))
        bodies.push_back({part.name, io::body_of(file, part, options)});
    return bodies;
}

} // namespace chasles
