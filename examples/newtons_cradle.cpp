// Newton's cradle: five balls on rods, of which the first one is lifted. The balls hang a little apart, so each contact
// is one of two balls, and its time is found exactly. With a file name, writes a page to look at.
#include "examples/dynamics/recording.h"
#include "examples/dynamics/shapes.h"

#include <cstdio>

using namespace chasles;
using namespace chasles::examples;
using Eigen::Vector3d;

namespace {

constexpr double length = 0.2;     // metres, of a rod
constexpr double radius = 0.02;    // metres
constexpr double spacing = 0.0403; // metres
constexpr double lifted = 0.6;     // radians
constexpr double frequency = 240;  // steps in a second

World cradle() {
    World world({.margin = 1e-4, .gravity = {0, 0, -9.81}, .restitution = 1});
    const Polyhedron shape = ball(radius, 12);
    for (int i = 0; i < 5; ++i) {
        RigidBody body = solid(shape, 7800);
        const Vector3d pivot(spacing * i, 0, length);
        body.hinge = Hinge{pivot, Vector3d::UnitY()};
        body.pose = Eigen::Translation3d(pivot) * Eigen::AngleAxisd(i == 0 ? lifted : 0, Vector3d::UnitY()) *
                    Eigen::Translation3d(0, 0, -length);
        world.add("ball " + std::to_string(i + 1), shape, body);
    }
    const Vector3d end(4 * spacing + 0.01, 0.01, length + 0.01);
    world.add("beam", box({-0.01, -0.01, length - 0.001}, end), RigidBody());
    return world;
}

} // namespace

int main(int argc, char** argv) {
    World world = cradle();
    Recording recording(world, "Newton's cradle");
    recording.run(480, 1 / frequency, 2);
    std::printf("%zu contacts in %.3f s\n", world.events(), world.time());
    for (const RigidBody& body : world.bodies())
        if (body.moves())
            std::printf("angle %6.3f, turning at %6.3f a second\n",
                        std::asin((body.hinge->point - body.pose.translation()).x() / length),
                        body.velocity.angular.y());
    if (argc > 1)
        recording.write(argv[1]);
    return 0;
}
