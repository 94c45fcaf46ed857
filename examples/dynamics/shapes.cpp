#include "examples/dynamics/shapes.h"

#include <array>
#include <cmath>
#include <numbers>

namespace chasles::examples {

using Eigen::Vector3d;

namespace {

using Faces = std::vector<std::vector<std::uint32_t>>;
constexpr double pi = std::numbers::pi;

/// Quadrilaterals between ring `below` and the next one, each of `sides` corners from `first` on.
void add_belt(Faces& faces, std::uint32_t first, std::uint32_t below, std::uint32_t sides) {
    const auto corner = [&](std::uint32_t ring, std::uint32_t side) { return first + ring * sides + side % sides; };
    for (std::uint32_t side = 0; side < sides; ++side)
        faces.push_back(
            {corner(below, side), corner(below, side + 1), corner(below + 1, side + 1), corner(below + 1, side)});
}

} // namespace

Polyhedron box(const Vector3d& lower, const Vector3d& upper) {
    std::vector<Vector3d> corners;
    for (int i = 0; i < 8; ++i)
        corners.emplace_back((i & 1 ? upper : lower).x(), (i & 2 ? upper : lower).y(), (i & 4 ? upper : lower).z());
    return Polyhedron::from_polygons(
        corners, Faces{{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}});
}

Polyhedron ball(double radius, int rings) {
    const auto sides = std::uint32_t(2 * rings);
    std::vector<Vector3d> corners{{0, 0, -radius}};
    for (int ring = 1; ring < rings; ++ring)
        for (std::uint32_t side = 0; side < sides; ++side) {
            const double down = pi * ring / rings, around = 2 * pi * side / sides;
            corners.push_back(radius * Vector3d(std::sin(down) * std::cos(around), std::sin(down) * std::sin(around),
                                                -std::cos(down)));
        }
    corners.emplace_back(0, 0, radius);
    const auto top = std::uint32_t(corners.size() - 1), last = top - sides;
    Faces faces;
    for (std::uint32_t side = 0; side < sides; ++side) {
        faces.push_back({0, 1 + (side + 1) % sides, 1 + side});
        faces.push_back({top, last + side, last + (side + 1) % sides});
    }
    for (int ring = 0; ring + 2 < rings; ++ring)
        add_belt(faces, 1, std::uint32_t(ring), sides);
    return Polyhedron::from_polygons(corners, faces, {.triangulate = true});
}

Polyhedron hexagon_bolt(double across_corners, double head, double shank_diameter, double length) {
    constexpr std::uint32_t sides = 12; // six corners of the hexagon, and the middles between them
    struct Ring {
        double radius, height;
        bool is_hexagon;
    };
    const std::array<Ring, 4> rings{{{across_corners / 2, 0, true},
                                     {across_corners / 2, head, true},
                                     {shank_diameter / 2, head, false},
                                     {shank_diameter / 2, length, false}}};
    std::vector<Vector3d> corners;
    for (const auto& [radius, height, is_hexagon] : rings)
        for (std::uint32_t side = 0; side < sides; ++side) {
            const double around = 2 * pi * side / sides;
            const double reach = is_hexagon && side % 2 == 1 ? radius * std::cos(pi / 6) : radius;
            corners.emplace_back(reach * std::cos(around), reach * std::sin(around), height);
        }
    Faces faces(2);
    for (std::uint32_t side = 0; side < sides; ++side) {
        faces[0].push_back(sides - 1 - side);
        faces[1].push_back(3 * sides + side);
    }
    for (std::uint32_t ring = 0; ring < 3; ++ring)
        add_belt(faces, 0, ring, sides);
    return Polyhedron::from_polygons(corners, faces);
}

} // namespace chasles::examples
