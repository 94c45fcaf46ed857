#include "examples/dragging/shapes.h"

#include <cmath>
#include <numbers>

namespace chasles::examples {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Faces = std::vector<std::vector<std::uint32_t>>;

} // namespace

Polyhedron extruded(const std::vector<Vector2d>& outline, double height) {
    std::vector<Vector3d> vertices;
    Faces faces;
    std::vector<std::uint32_t> lower, upper;
    const auto count = std::uint32_t(outline.size());
    for (std::uint32_t i = 0; i < count; ++i) {
        vertices.emplace_back(outline[i].x(), outline[i].y(), 0);
        vertices.emplace_back(outline[i].x(), outline[i].y(), height);
        const std::uint32_t here = 2 * i, next = 2 * ((i + 1) % count);
        faces.push_back({here, next, next + 1, here + 1});
        lower.insert(lower.begin(), here);
        upper.push_back(here + 1);
    }
    faces.push_back(lower);
    faces.push_back(upper);
    return Polyhedron::from_polygons(vertices, faces);
}

Polyhedron turned_ring(const std::vector<Vector2d>& outline, int sides) {
    std::vector<Vector3d> vertices;
    Faces faces;
    const auto count = std::uint32_t(outline.size());
    for (std::uint32_t side = 0; side < std::uint32_t(sides); ++side) {
        const double angle = 2 * std::numbers::pi * side / sides;
        const std::uint32_t next = (side + 1) % std::uint32_t(sides);
        for (std::uint32_t i = 0; i < count; ++i) {
            vertices.emplace_back(outline[i].x() * std::cos(angle), outline[i].x() * std::sin(angle), outline[i].y());
            const std::uint32_t j = (i + 1) % count;
            faces.push_back({side * count + i, next * count + i, next * count + j, side * count + j});
        }
    }
    return Polyhedron::from_polygons(vertices, faces, {.triangulate = true});
}

Polyhedron rod(double radius, double height, int sides) {
    std::vector<Vector2d> outline;
    for (int i = 0; i < sides; ++i)
        outline.emplace_back(radius * std::cos(2 * std::numbers::pi * i / sides),
                             radius * std::sin(2 * std::numbers::pi * i / sides));
    return extruded(outline, height);
}

} // namespace chasles::examples
