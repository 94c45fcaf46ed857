#include "bench/bodies.h"

#include <cmath>
#include <cstdio>
#include <numbers>

namespace chasles::bench {

Polyhedron bumpy_torus(std::size_t rings, std::size_t sides) {
    const auto angle = [](std::size_t i, std::size_t count) {
        return 2 * std::numbers::pi * double(i) / double(count);
    };
    std::vector<Eigen::Vector3d> vertices;
    std::vector<std::vector<std::uint32_t>> faces;
    for (std::size_t i = 0; i < rings; ++i) {
        for (std::size_t j = 0; j < sides; ++j) {
            const double around = angle(i, rings);
            const double across = angle(j, sides);
            const double tube = 0.3 + 0.03 * std::cos(11 * around) * std::sin(5 * across);
            const double radius = 0.67 + tube * std::cos(across);
            vertices.emplace_back(radius * std::cos(around), radius * std::sin(around), tube * std::sin(across));
        }
    }
    const auto id = [&](std::size_t i, std::size_t j) { return std::uint32_t(i % rings * sides + j % sides); };
    for (std::size_t i = 0; i < rings; ++i) {
        for (std::size_t j = 0; j < sides; ++j) {
            faces.push_back({id(i, j), id(i + 1, j), id(i + 1, j + 1)});
            faces.push_back({id(i, j), id(i + 1, j + 1), id(i, j + 1)});
        }
    }
    return Polyhedron::from_polygons(vertices, faces);
}

std::vector<std::array<std::uint32_t, 3>> triangles_of(const Polyhedron& body) {
    std::vector<std::array<std::uint32_t, 3>> triangles;
    for (std::size_t face = 0; face < body.face_count(); ++face) {
        const auto outline = body.face(face);
        for (std::size_t i = 1; i + 1 < outline.size(); ++i)
            triangles.push_back({outline[0], outline[i], outline[i + 1]});
    }
    return triangles;
}

std::optional<std::filesystem::path> data_file(const std::string& path) {
    const std::filesystem::path file = std::filesystem::path(CHASLES_DATA_DIR) / path;
    std::error_code unreadable;
    if (std::string(CHASLES_DATA_DIR).empty() || !std::filesystem::is_regular_file(file, unreadable))
        return std::nullopt;
    return file;
}

NamedBody large_body() {
    if (const auto file = data_file("meshes/stanford-bunny.obj"))
        return {"bunny", Polyhedron::load(*file)};
    std::printf(
        "skipped: meshes/stanford-bunny.obj is not there; a bumpy torus of as many triangles is used instead\n");
    return {"torus", bumpy_torus(264, 132)};
}

std::optional<NutAndBolt> m16_nut_and_bolt() {
    const auto nut = data_file("assembly-factory/factory_nut_m16_loose_subdiv_3x.obj");
    const auto bolt = data_file("assembly-factory/factory_bolt_m16_loose.obj");
    if (!nut || !bolt) {
        std::printf("skipped: the M16 nut and bolt of assembly-factory are missing\n");
        return std::nullopt;
    }
    return NutAndBolt{Polyhedron::load(*nut), Polyhedron::load(*bolt)};
}

std::optional<Polyhedron> small_gear() {
    const auto file = data_file("assembly-factory/factory_gear_small_space_5e-4.obj");
    if (!file) {
        std::printf("skipped: the gear of assembly-factory is missing\n");
        return std::nullopt;
    }
    return Polyhedron::load(*file);
}

} // namespace chasles::bench
