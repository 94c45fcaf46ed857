// Scenes of random bodies on random motions.
#pragma once

#include "chasles/scene/scene.h"
#include "tests/query/bodies.h"
#include "tests/support/random_poses.h"

#include <random>
#include <string>

namespace chasles::test {

/// Every third body stands still, and others move or turn evenly. Small worlds are crowded.
inline Scene moving_octahedra(Random& random, int count, double size) {
    std::mt19937 shapes_random(unsigned(random.integer(0, 1 << 30)));
    Scene world;
    for (int i = 0; i < count; ++i) {
        const Pose start = random_pose(random, size), goal = random_pose(random, size);
        const Motion motion = i % 3 == 0   ? Motion::at_rest(start)
                              : i % 3 == 1 ? Motion::velocity(start, goal)
                                           : Motion::twist(start, goal);
        world.add({std::to_string(i), random_octahedron(shapes_random).polyhedron(), motion, ""});
    }
    return world;
}

} // namespace chasles::test
