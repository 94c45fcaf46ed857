// Bolts fall into a box and come to rest. With a file name, writes a page to look at.
#include "examples/dynamics/recording.h"
#include "examples/dynamics/shapes.h"

#include <cstdio>
#include <random>

using namespace chasles;
using namespace chasles::examples;
using Eigen::Vector3d;

namespace {

constexpr int count = 12;
constexpr double half = 0.03;     // metres, of the inside of the box
constexpr double frequency = 480; // steps in a second

void add_box(World& world) {
    constexpr double thick = 0.002, height = 0.05, outside = half + thick;
    world.add("floor", box({-outside, -outside, -thick}, {outside, outside, 0}), RigidBody());
    for (int i = 0; i < 4; ++i) {
        Vector3d lower(-outside, -outside, 0), upper(outside, outside, height);
        (i % 2 == 0 ? upper : lower)[i / 2] = i % 2 == 0 ? -half : half;
        world.add("wall " + std::to_string(i + 1), box(lower, upper), RigidBody());
    }
}

World falling_bolts() {
    World world({.margin = 5e-5, .gravity = {0, 0, -9.81}, .restitution = 0.2, .friction = 0.4});
    const Polyhedron shape = hexagon_bolt(0.013, 0.004, 0.008, 0.024);
    std::mt19937 random(3);
    const auto draw = [&](double size) {
        Eigen::Vector4d numbers;
        for (double& number : numbers)
            number = std::uniform_real_distribution<double>(-size, size)(random);
        return numbers;
    };
    for (int i = 0; i < count; ++i) {
        RigidBody body = solid(shape, 7800);
        Vector3d place = draw(0.004).head<3>();
        place.z() = 0.03 + 0.03 * i;
        body.pose = Eigen::Translation3d(place) * Eigen::Quaterniond(draw(1)).normalized();
        body.velocity.angular = draw(5).head<3>();
        world.add("bolt " + std::to_string(i + 1), shape, body);
    }
    add_box(world);
    return world;
}

} // namespace

int main(int argc, char** argv) {
    World world = falling_bolts();
    Recording recording(world, "A box of bolts");
    recording.run(384, 1 / frequency, 8);
    int inside = 0;
    for (const RigidBody& body : world.bodies())
        if (body.moves() && body.centre_in_world().head<2>().cwiseAbs().maxCoeff() < half)
            ++inside;
    std::printf("%d of %d bolts are in the box after %.1f s, with %zu events; their energy is %.1g J\n", inside, count,
                world.time(), world.events(), world.kinetic_energy());
    if (argc > 1)
        recording.write(argv[1]);
    return 0;
}
