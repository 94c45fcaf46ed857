// Apart from the other functions of a mesh, because WebAssembly has no files.
#include "chasles/base/invalid_input.h"
#include "scenes/triangle_mesh.h"

#include <fmt/core.h>
#include <fstream>

namespace chasles::scenes {

void save_obj(const Polyhedron& body, const std::filesystem::path& file) {
    const std::filesystem::path part = file.string() + ".part"; // a former file stays until the new one is whole
    std::ofstream out(part);
    for (const Eigen::Vector3d& vertex : body.vertices()) {
        out << fmt::format("v {} {} {}\n", vertex.x(), vertex.y(), vertex.z());
    }
    for (std::size_t face = 0; face < body.face_count(); ++face) {
        out << 'f';
        for (const Index corner : body.face(face))
            out << ' ' << corner + 1;
        out << '\n';
    }
    out.close();
    std::error_code error;
    if (out)
        std::filesystem::rename(part, std::filesystem::exists(file) ? std::filesystem::canonical(file) : file, error);
    if (!out || error) {
        std::filesystem::remove(part, error);
        throw InvalidInput(fmt::format("{}: the file cannot be written", file.string()));
    }
}

} // namespace chasles::scenes
