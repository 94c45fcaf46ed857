// Six walls around a cube, for bodies that fly.
#pragma once

#include "examples/dynamics/world.h"
#include "tests/query/bodies.h"

namespace chasles::test {

struct Wall {
    std::string name;
    Polyhedron shape;
    examples::RigidBody body;
};

/// Around the cube from 0 to `size` on all axes. They overlap at the edges, and do not move.
inline std::vector<Wall> walls_around(double size) {
    std::vector<Wall> walls;
    for (int i = 0; i < 6; ++i) {
        examples::RigidBody body;
        body.pose.translation() = Eigen::Vector3d::Constant(size / 2);
        body.pose.translation()[i / 2] += (i % 2 == 0 ? -1 : 1) * (size / 2 + 1);
        Eigen::Vector3d half = Eigen::Vector3d::Constant(size);
        half[i / 2] = 1;
        walls.push_back({"wall " + std::to_string(i), box(half).polyhedron(), body});
    }
    return walls;
}

} // namespace chasles::test
