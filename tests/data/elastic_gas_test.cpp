// Elastic boxes and bunnies in a box of walls: the energy is kept, and neither samples by FCL nor queries about single
// flights find an overlap. CHASLES_LONG=1 takes a thousand bodies and twenty thousand contacts.
#include "examples/dynamics/world.h"
#include "tests/data/shared_data.h"
#include "tests/support/random_poses.h"
#include "tests/support/walls.h"

#include <cstdlib>
#include <gtest/gtest.h>
#if CHASLES_TESTS_FCL
#include "bench/fcl_scene.h"
#endif

namespace chasles::test {
namespace {

using Eigen::Vector3d;
using examples::RigidBody;
using examples::World;

/// The bunny with a diagonal of 1.5 around the origin.
Polyhedron bunny() {
    const Polyhedron given = Polyhedron::load(shared_data("meshes") / "bunny-lowpoly.obj");
    const auto report = given.report();
    const double scale = 1.5 / (report.upper - report.lower).norm();
    std::vector<Vector3d> vertices;
    for (const Vector3d& vertex : given.vertices())
        vertices.push_back(scale * (vertex - 0.5 * (report.lower + report.upper)));
    std::vector<std::vector<std::uint32_t>> faces;
    for (std::size_t face = 0; face < given.face_count(); ++face)
        faces.emplace_back(given.face(face).begin(), given.face(face).end());
    return Polyhedron::from_polygons(vertices, faces);
}

constexpr double margin = 1e-3;

/// All have one moment of inertia about all axes, so that they turn evenly.
World gas(int count) {
    const std::array<Polyhedron, 2> kinds{box({0.3, 0.4, 0.5}).polyhedron(), bunny()};
    const int side = int(std::ceil(std::cbrt(count)));
    World world({.margin = margin, .restitution = 1});
    Random random(19);
    for (int i = 0; i < count; ++i) {
        RigidBody body;
        body.mass = 1 + i % 3;
        body.inertia = 0.1 * body.mass * Eigen::Matrix3d::Identity();
        const Vector3d cell(i % side, i / side % side, i / side / side);
        body.pose =
            Eigen::Translation3d(1.7 * cell + Vector3d::Constant(0.85)) * random_pose(random, 0).rotation.normalized();
        body.velocity = {random_point(random, 1), random_point(random, 2)};
        world.add("body " + std::to_string(i), kinds[std::size_t(i % 2)], body);
    }
    for (const auto& [name, shape, body] : walls_around(1.7 * side))
        world.add(name, shape, body);
    return world;
}

/// All bodies from the event before to the present one, at their present velocities.
Scene flights(World& world, double since) {
    Scene scene;
    scene.ignore_groups("fixed", "fixed");
    for (std::size_t i = 0; i < world.bodies().size(); ++i) {
        const SceneBody& body = world.scene().bodies()[i];
        RigidBody before = world.bodies()[i];
        if (before.moves())
            before.pose = before.flight(since - world.time()).pose_at(1).isometry();
        scene.add({body.name, body.shape, before.flight(world.time() - since), before.moves() ? "" : "fixed"});
    }
    return scene;
}

TEST(ElasticGas, KeepsItsEnergyAndNothingOverlaps) {
    CHASLES_REQUIRE_DATA("meshes");
    const bool is_long = std::getenv("CHASLES_LONG") != nullptr;
    const std::size_t contacts = is_long ? 20'000 : 1000;
    World world = gas(is_long ? 1000 : 100);
    const double energy = world.kinetic_energy();
    double before = 0;
    std::size_t checks = 0;
    world.before_impulses = [&](const StepEvent&) {
        if (world.events() % 20 == 0) {
            ++checks;
            const Scene scene = flights(world, before);
            EXPECT_EQ(scene.first_contact().verdict, Verdict::clear) << "event " << world.events();
#if CHASLES_TESTS_FCL
            bench::FclScene fcl(scene);
            for (const double time : {0.5, 1.0})
                EXPECT_FALSE(fcl.collides_at(time)) << "event " << world.events();
#endif
        }
        before = world.time();
    };
    while (world.events() < contacts) {
        world.step(0.1);
        before = world.time();
    }
    EXPECT_GE(checks, contacts / 20);
    EXPECT_NEAR(world.kinetic_energy(), energy, 1e-9 * energy);
    std::printf("%zu bodies, %zu contacts in %.2f s: energy off by %.1e, %zu checks\n", world.bodies().size(),
                world.events(), world.time(), world.kinetic_energy() / energy - 1, checks);
}

} // namespace
} // namespace chasles::test
