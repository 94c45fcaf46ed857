// Bodies and hands for the tests of dragged bodies, and an oracle of distances.
#pragma once

#include "chasles/manipulation/dragged_body.h"
#include "tests/query/bodies.h"
#include "tests/query/posed_distance.h"
#include "tests/support/random_poses.h"

#include <numbers>

namespace chasles::test {

/// A prism over a regular polygon about z, from z = 0 to `height`; the first corner is on the x axis.
inline Body prism(int sides, double radius, double height) {
    Body body;
    std::vector<std::uint32_t> lower, upper;
    for (int i = 0; i < sides; ++i) {
        const double angle = 2 * std::numbers::pi * i / sides;
        body.vertices.emplace_back(radius * std::cos(angle), radius * std::sin(angle), 0);
        body.vertices.emplace_back(radius * std::cos(angle), radius * std::sin(angle), height);
        const auto here = std::uint32_t(2 * i), next = std::uint32_t(2 * ((i + 1) % sides));
        body.faces.push_back({here, next, next + 1, here + 1});
        lower.insert(lower.begin(), here);
        upper.push_back(here + 1);
    }
    body.faces.push_back(lower);
    body.faces.push_back(upper);
    return body;
}

/// A plate around a hole of the same form, from z = 0 to `height`.
inline Body plate_with_hole(int sides, double hole, double rim, double height) {
    Body body;
    for (int i = 0; i < sides; ++i) {
        const double angle = 2 * std::numbers::pi * i / sides;
        for (const double radius : {hole, rim})
            for (const double z : {0.0, height})
                body.vertices.emplace_back(radius * std::cos(angle), radius * std::sin(angle), z);
        const auto a = std::uint32_t(4 * i), b = std::uint32_t(4 * ((i + 1) % sides));
        body.faces.push_back({a, a + 1, b + 1, b});         // inside
        body.faces.push_back({a + 2, b + 2, b + 3, a + 3}); // outside
        body.faces.push_back({a, b, b + 2, a + 2});         // below
        body.faces.push_back({a + 1, a + 3, b + 3, b + 1}); // above
    }
    return body;
}

/// A ring of round section about z, of triangles.
inline Body torus(double radius, double section, int around, int across) {
    Body body;
    const auto id = [&](int i, int j) { return std::uint32_t((i % around) * across + j % across); };
    for (int i = 0; i < around; ++i)
        for (int j = 0; j < across; ++j) {
            const double a = 2 * std::numbers::pi * i / around, b = 2 * std::numbers::pi * j / across;
            const double from_axis = radius + section * std::cos(b);
            body.vertices.emplace_back(from_axis * std::cos(a), from_axis * std::sin(a), section * std::sin(b));
            body.faces.push_back({id(i, j), id(i + 1, j), id(i + 1, j + 1)});
            body.faces.push_back({id(i, j), id(i + 1, j + 1), id(i, j + 1)});
        }
    return body;
}

/// Three walls of a corner, x, y and z from 0: two-sided surfaces.
inline Body corner(double size) {
    Body body;
    body.vertices = {{0, 0, 0},       {size, 0, 0},    {0, size, 0},   {0, 0, size},
                     {size, size, 0}, {size, 0, size}, {0, size, size}};
    body.faces = {{0, 1, 4, 2}, {0, 3, 5, 1}, {0, 2, 6, 3}};
    return body;
}

/// The least distance of a body of a scene from all others, where their motions end; by all pairs of triangles.
inline double distance_from_others(const Scene& scene, const std::string& name, const Pose& pose) {
    double least = std::numeric_limits<double>::infinity();
    const std::size_t dragged = scene.index_of(name);
    for (std::size_t i = 0; i < scene.bodies().size(); ++i) {
        const SceneBody& other = scene.bodies()[i];
        const Eigen::Isometry3d there = other.motion.pose_at(1).isometry();
        if (i != dragged)
            least = std::min(least, distance_at(scene.bodies()[dragged].shape, other.shape,
                                                Pose(there.inverse() * pose.isometry())));
    }
    return least;
}

} // namespace chasles::test
