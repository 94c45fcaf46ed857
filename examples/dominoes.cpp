// A chain of dominoes, of which the first one is pushed. With a file name, writes a page to look at.
#include "examples/dynamics/recording.h"
#include "examples/dynamics/shapes.h"

#include <cmath>
#include <cstdio>
#include <numbers>

using namespace chasles;
using namespace chasles::examples;
using Eigen::Vector3d;

namespace {

constexpr int count = 20;
constexpr double height = 0.048;  // metres
constexpr double spacing = 0.02;  // metres
constexpr double margin = 1e-4;   // metres
constexpr double frequency = 240; // steps in a second

World chain() {
    World world({.margin = margin, .gravity = {0, 0, -9.81}, .friction = 0.4});
    const Polyhedron shape = box({-0.004, -0.012, -height / 2}, {0.004, 0.012, height / 2});
    for (int i = 0; i < count; ++i) {
        RigidBody body = solid(shape, 800);
        body.pose.translation() = Vector3d(spacing * i, 0, height / 2 + 1.5 * margin);
        if (i == 0)
            body.velocity = {{8 * height / 2, 0, 0}, {0, 8, 0}};
        world.add("domino " + std::to_string(i + 1), shape, body);
    }
    world.add("table", box({-0.1, -0.1, -0.02}, {spacing * count + 0.1, 0.1, 0}), RigidBody());
    return world;
}

double tilt_of(const RigidBody& body) {
    return std::acos(std::min(1.0, body.pose.linear()(2, 2))) * 180 / std::numbers::pi;
}

} // namespace

int main(int argc, char** argv) {
    World world = chain();
    Recording recording(world, "Dominoes");
    recording.run(288, 1 / frequency, 4);
    int fallen = 0;
    for (const RigidBody& body : world.bodies())
        if (body.moves() && tilt_of(body) > 60)
            ++fallen;
    std::printf("%d of %d dominoes have fallen after %.2f s, with %zu events\n", fallen, count, world.time(),
                world.events());
    if (argc > 1)
        recording.write(argv[1]);
    return 0;
}
