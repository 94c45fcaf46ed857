#include "bench/generated_bodies.h"

#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

namespace chasles::bench {

namespace {

struct Mesh {
    std::vector<Eigen::Vector3d> vertices;
    std::vector<std::vector<std::uint32_t>> faces;
};

/// Cuts each triangle into four. Neighbours share the new corners.
Mesh cut_in_four(const Mesh& mesh) {
    Mesh finer{mesh.vertices, {}};
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
        const auto [place, is_new] = middles.try_emplace(std::minmax(a, b), std::uint32_t(finer.vertices.size()));
        if (is_new)
            finer.vertices.emplace_back(0.5 * (mesh.vertices[a] + mesh.vertices[b]));
        return place->second;
    };
    for (const auto& face : mesh.faces) {
        const std::uint32_t ab = middle(face[0], face[1]);
        const std::uint32_t bc = middle(face[1], face[2]);
        const std::uint32_t ca = middle(face[2], face[0]);
        finer.faces.insert(finer.faces.end(), {{face[0], ab, ca}, {ab, face[1], bc}, {ca, bc, face[2]}, {ab, bc, ca}});
    }
    return finer;
}

Mesh icosahedron() {
    const double g = std::numbers::phi;
    return {{{-1, g, 0},
             {1, g, 0},
             {-1, -g, 0},
             {1, -g, 0},
             {0, -1, g},
             {0, 1, g},
             {0, -1, -g},
             {0, 1, -g},
             {g, 0, -1},
             {g, 0, 1},
             {-g, 0, -1},
             {-g, 0, 1}},
            {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
             {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
             {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}}};
}

/// Adds a regular polygon. Returns its vertex ids, counter-clockwise when viewed from above.
std::vector<std::uint32_t> add_ring(Mesh& mesh, std::size_t sides, double radius, double height) {
    std::vector<std::uint32_t> ring;
    for (std::size_t i = 0; i < sides; ++i) {
        const double angle = 2 * std::numbers::pi * double(i) / double(sides);
        ring.push_back(std::uint32_t(mesh.vertices.size()));
        mesh.vertices.emplace_back(radius * std::cos(angle), radius * std::sin(angle), height);
    }
    return ring;
}

/// Adds the strip of triangles between two rings. Its front is the side from which `from` runs counter-clockwise below
/// `to`.
void join(Mesh& mesh, const std::vector<std::uint32_t>& from, const std::vector<std::uint32_t>& to) {
    for (std::size_t i = 0; i < from.size(); ++i) {
        const std::size_t next = (i + 1) % from.size();
        mesh.faces.push_back({from[i], from[next], to[next]});
        mesh.faces.push_back({from[i], to[next], to[i]});
    }
}

/// Adds the prism between two outlines and two holes.
void join_all(Mesh& mesh, const std::array<std::vector<std::uint32_t>, 4>& rings) {
    for (std::size_t i = 0; i < 4; ++i)
        join(mesh, rings[i], rings[(i + 1) % 4]);
}

} // namespace

Polyhedron ellipsoid(const Eigen::Vector3d& half_axes, int subdivisions) {
    Mesh mesh = icosahedron();
    for (int i = 0; i < subdivisions; ++i) {
        mesh = cut_in_four(mesh);
        for (Eigen::Vector3d& vertex : mesh.vertices)
            vertex.normalize();
    }
    for (Eigen::Vector3d& vertex : mesh.vertices)
        vertex = half_axes.cwiseProduct(vertex.normalized()).eval();
    return Polyhedron::from_polygons(mesh.vertices, mesh.faces);
}

Polyhedron subdivided(const Polyhedron& body, int times) {
    Mesh mesh{{body.vertices().begin(), body.vertices().end()}, {}};
    for (std::size_t face = 0; face < body.face_count(); ++face)
        mesh.faces.emplace_back(body.face(face).begin(), body.face(face).end());
    for (int i = 0; i < times; ++i)
        mesh = cut_in_four(mesh);
    return Polyhedron::from_polygons(mesh.vertices, mesh.faces);
}

Polyhedron peg(const Prism& size) {
    Mesh mesh;
    const auto bottom = add_ring(mesh, size.sides, size.radius, 0);
    const auto top = add_ring(mesh, size.sides, size.radius, size.height);
    join(mesh, bottom, top);
    for (std::size_t i = 1; i + 1 < size.sides; ++i) {
        mesh.faces.push_back({bottom[0], bottom[i + 1], bottom[i]});
        mesh.faces.push_back({top[0], top[i], top[i + 1]});
    }
    return Polyhedron::from_polygons(mesh.vertices, mesh.faces);
}

Polyhedron plate_with_hole(const Prism& plate, double hole_radius) {
    Mesh mesh;
    const auto bottom = add_ring(mesh, plate.sides, plate.radius, 0);
    const auto top = add_ring(mesh, plate.sides, plate.radius, plate.height);
    const auto hole_top = add_ring(mesh, plate.sides, hole_radius, plate.height);
    const auto hole_bottom = add_ring(mesh, plate.sides, hole_radius, 0);
    join_all(mesh, {bottom, top, hole_top, hole_bottom});
    return Polyhedron::from_polygons(mesh.vertices, mesh.faces);
}

} // namespace chasles::bench
