// Small bodies and outlines for the tests of this layer.
#pragma once

#include "chasles/mesh/polyhedron.h"
#include "tests/mesh/read_obj.h"

#include <cmath>
#include <numbers>
#include <random>

namespace chasles::test {

using Outline = std::vector<Eigen::Vector2d>;

inline Polyhedron made_from(const Soup& soup, const PolyhedronOptions& options = {}) {
    return Polyhedron::from_polygons(soup.vertices, soup.faces, options);
}

/// The unit cube of six quads, counter-clockwise when viewed from outside. The bits of i are the coordinates of vertex
/// i.
inline Soup cube() {
    Soup soup;
    for (int i = 0; i < 8; ++i)
        soup.vertices.emplace_back(i & 1, (i >> 1) & 1, (i >> 2) & 1);
    soup.faces = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
    return soup;
}

/// A closed torus of 2 around * across triangles.
inline Soup torus(std::uint32_t around, std::uint32_t across) {
    Soup soup;
    for (std::uint32_t i = 0; i < around; ++i)
        for (std::uint32_t j = 0; j < across; ++j) {
            const double u = 2 * std::numbers::pi * i / around;
            const double v = 2 * std::numbers::pi * j / across;
            const double radius = 1 + 0.3 * std::cos(v);
            soup.vertices.emplace_back(radius * std::cos(u), radius * std::sin(u), 0.3 * std::sin(v));
        }
    const auto at = [&](std::uint32_t i, std::uint32_t j) { return (i % around) * across + j % across; };
    for (std::uint32_t i = 0; i < around; ++i)
        for (std::uint32_t j = 0; j < across; ++j) {
            soup.faces.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
            soup.faces.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
        }
    return soup;
}

/// One polygon in the plane z = 0.
inline Soup sheet(const Outline& outline) {
    Soup soup;
    std::vector<std::uint32_t> face;
    for (const Eigen::Vector2d& corner : outline) {
        face.push_back(static_cast<std::uint32_t>(soup.vertices.size()));
        soup.vertices.emplace_back(corner.x(), corner.y(), 0.0);
    }
    soup.faces.push_back(face);
    return soup;
}

/// A simple outline that every ray from the origin crosses once. It is almost never convex.
inline Outline random_star(std::mt19937& random, std::size_t corners) {
    std::uniform_real_distribution<double> radius(0.1, 1.0);
    Outline outline;
    for (std::size_t i = 0; i < corners; ++i) {
        const double angle = 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(corners);
        const double r = radius(random);
        outline.emplace_back(r * std::cos(angle), r * std::sin(angle));
    }
    return outline;
}

/// A square of side 4 with a square hole of side 2. A bridge from corner 0 connects both; the outline runs along the
/// bridge twice.
inline Outline square_with_bridged_hole() {
    return {{0, 0}, {4, 0}, {4, 4}, {0, 4}, {0, 0}, {1, 1}, {1, 3}, {3, 3}, {3, 1}, {1, 1}};
}

inline double signed_area(const Outline& outline) {
    double twice = 0.0;
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const Eigen::Vector2d& a = outline[i];
        const Eigen::Vector2d& b = outline[(i + 1) % outline.size()];
        twice += a.x() * b.y() - a.y() * b.x();
    }
    return twice / 2;
}

} // namespace chasles::test
