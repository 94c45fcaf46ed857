// Small bodies and poses for the tests of this layer.
#pragma once

#include "chasles/query/first_contact.h"
#include "tests/support/grid.h"

#include <Eigen/Geometry>
#include <random>

namespace chasles::test {

using Vertices = std::vector<Eigen::Vector3d>;
using Faces = std::vector<std::vector<std::uint32_t>>;

/// Vertices and faces that a test can transform before it makes a polyhedron.
struct Body {
    Vertices vertices;
    Faces faces;

    [[nodiscard]] Polyhedron polyhedron() const { return Polyhedron::from_polygons(vertices, faces); }
};

/// The box [-h, h] of six quads. The bits of i are the signs of x, y, z of vertex i.
inline Body box(const Eigen::Vector3d& half) {
    Body body;
    for (int i = 0; i < 8; ++i)
        body.vertices.emplace_back((i & 1 ? 1 : -1) * half.x(), (i & 2 ? 1 : -1) * half.y(),
                                   (i & 4 ? 1 : -1) * half.z());
    body.faces = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
    return body;
}

/// Adds a box to a body.
inline void add_box(Body& body, const Eigen::Vector3d& middle, const Eigen::Vector3d& half) {
    const auto first = std::uint32_t(body.vertices.size());
    const Body added = box(half);
    for (const Eigen::Vector3d& vertex : added.vertices)
        body.vertices.push_back(vertex + middle);
    for (std::vector<std::uint32_t> face : added.faces) {
        for (std::uint32_t& corner : face)
            corner += first;
        body.faces.push_back(face);
    }
}

/// A rod, and a block that it stands in. The edges of the rod pass through the edges between the four triangles of the
/// block's top.
inline std::pair<Polyhedron, Polyhedron> rod_through_flat_edges() {
    Body block = box({1, 1, 1});
    block.faces.pop_back(); // the top
    block.vertices.emplace_back(0, 0, 1);
    for (const auto& [from, to] : {std::pair(4U, 5U), {5U, 7U}, {7U, 6U}, {6U, 4U}})
        block.faces.push_back({from, to, 8U});
    Body rod;
    add_box(rod, {0, 0, 1.05}, {0.25, 0.25, 1.95});
    return {rod.polyhedron(), block.polyhedron()};
}

inline Body triangle(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
    return {{a, b, c}, {{0, 1, 2}}};
}

inline double uniform(std::mt19937& random, double from, double to) {
    return std::uniform_real_distribution<double>(from, to)(random);
}

inline Eigen::Vector3d random_vector(std::mt19937& random, double size) {
    return {uniform(random, -size, size), uniform(random, -size, size), uniform(random, -size, size)};
}

/// A closed octahedron of eight triangles with perturbed corners.
inline Body random_octahedron(std::mt19937& random) {
    Body body;
    for (int axis = 0; axis < 3; ++axis)
        for (const double sign : {1.0, -1.0})
            body.vertices.push_back(sign * Eigen::Vector3d::Unit(axis) * uniform(random, 0.3, 1) +
                                    random_vector(random, 0.15));
    body.faces = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
    return body;
}

inline Pose shifted(double x, double y, double z) {
    return {Eigen::Vector3d(x, y, z), Eigen::Quaterniond::Identity()};
}

inline Pose turned(const Eigen::Vector3d& position, const Eigen::Vector3d& axis, double angle) {
    return {position, Eigen::Quaterniond(Eigen::AngleAxisd(angle, axis.normalized()))};
}

inline Pose random_pose(std::mt19937& random, double distance, double turn) {
    return turned(random_vector(random, distance), random_vector(random, 1), uniform(random, -turn, turn));
}

/// outer * inner, in double precision.
inline Pose composed(const Pose& outer, const Pose& inner) {
    return {outer.rotation.normalized() * inner.translation + outer.translation, outer.rotation * inner.rotation};
}

/// A plate of 40 by 40 and of 2 n^2 triangles, the higher the farther from its middle.
inline Polyhedron bowed_plate(std::uint32_t n, double height, double bow) {
    Body body;
    for (std::uint32_t i = 0; i <= n; ++i)
        for (std::uint32_t j = 0; j <= n; ++j) {
            const double x = 40.0 * i / n - 20, y = 40.0 * j / n - 20;
            body.vertices.emplace_back(x, y, height + bow * (x * x + y * y) / 800);
        }
    body.faces = grid_triangles(n, n);
    return body.polyhedron();
}

} // namespace chasles::test
