// Steps from contact to contact: against closed forms, energy, and distances by all pairs of triangles.
#include "chasles/scene/stepper.h"

#include "examples/dynamics/world.h"
#include "tests/query/bodies.h"
#include "tests/query/posed_distance.h"
#include "tests/support/random_poses.h"
#include "tests/support/refusal.h"
#include "tests/support/walls.h"

#include <gtest/gtest.h>

namespace chasles::test {
namespace {

using Eigen::Vector3d;
using examples::RigidBody;
using examples::World;

constexpr double margin = 1e-3;

/// Boxes and octahedra in a box of walls, with one moment of inertia about all axes: then a body turns evenly.
World gas(int count, unsigned threads, bool reversed = false) {
    std::mt19937 shapes(5);
    const std::array<Polyhedron, 2> kinds{box({0.4, 0.5, 0.6}).polyhedron(), random_octahedron(shapes).polyhedron()};
    const int side = int(std::ceil(std::cbrt(count)));
    World world({.margin = margin, .restitution = 1, .threads = threads});
    Random random(12);
    std::vector<std::tuple<std::string, Polyhedron, RigidBody>> bodies;
    for (int i = 0; i < count; ++i) {
        const Polyhedron& shape = kinds[std::size_t(i % 2)];
        RigidBody body = examples::solid(shape, 1 + i % 3);
        body.inertia = Eigen::Matrix3d::Identity() * body.inertia.trace() / 3;
        const Vector3d cell(i % side, i / side % side, i / side / side);
        const Pose turned = random_pose(random, 0);
        body.pose = Eigen::Translation3d(2 * cell + Vector3d::Ones()) * turned.rotation.normalized();
        body.pose.translation() -= body.pose.linear() * body.centre;
        body.velocity = {random_point(random, 1), random_point(random, 2)};
        bodies.emplace_back("body " + std::to_string(i), shape, body);
    }
    for (const auto& [name, shape, body] : walls_around(2 * side))
        bodies.emplace_back(name, shape, body);
    if (reversed)
        std::reverse(bodies.begin(), bodies.end());
    for (const auto& [name, shape, body] : bodies)
        world.add(name, shape, body);
    return world;
}

/// The distance of two bodies of a world where they are now.
double distance_now(World& world, std::size_t a, std::size_t b) {
    const std::span<const SceneBody> bodies = world.scene().bodies();
    return distance_at(bodies[a].shape, bodies[b].shape, world.bodies()[b].pose.inverse() * world.bodies()[a].pose);
}

/// Balls around the origins of all bodies of these tests tell most pairs.
bool may_be_near(World& world, std::size_t a, std::size_t b) {
    const auto radius = [&](std::size_t i) {
        double most = 0;
        for (const Vector3d& vertex : world.scene().bodies()[i].shape.vertices())
            most = std::max(most, vertex.norm());
        return most;
    };
    const Vector3d way = world.bodies()[a].pose.translation() - world.bodies()[b].pose.translation();
    return way.norm() <= radius(a) + radius(b) + margin;
}

TEST(Stepper, AnElasticGasKeepsItsEnergyAndNothingOverlaps) {
    World world = gas(27, 0);
    const double energy = world.kinetic_energy();
    world.before_impulses = [&](const StepEvent& event) {
        for (const SceneContact& pair : event.contacts) {
            const double distance = distance_now(world, pair.moving, pair.fixed);
            EXPECT_LE(distance, margin * (1 + 1e-9));
            double least_gap = 1;
            for (const Contact& contact : pair.contact.contacts)
                least_gap = std::min(least_gap, contact.gap);
            EXPECT_NEAR(distance, least_gap, 1e-9);
        }
        for (std::size_t a = 0; a < 27; ++a)
            for (std::size_t b = 0; b < a; ++b)
                if (world.events() % 10 == 0 && may_be_near(world, a, b)) {
                    EXPECT_GT(distance_now(world, a, b), 1e-9) << a << " and " << b;
                }
    };
    while (world.events() < 500)
        world.step(0.1);
    EXPECT_NEAR(world.kinetic_energy(), energy, 1e-12 * energy);
}

/// The places of all bodies, by name.
std::map<std::string, Eigen::Matrix4d> places_after(World world, std::size_t events) {
    while (world.events() < events)
        world.step(0.15);
    std::map<std::string, Eigen::Matrix4d> places;
    for (std::size_t i = 0; i < world.bodies().size(); ++i)
        places[world.scene().bodies()[i].name] = world.bodies()[i].pose.matrix();
    return places;
}

TEST(Stepper, TheSameBitForBitForAnyOrderAndAnyNumberOfThreads) {
    const auto one = places_after(gas(20, 1), 200);
    EXPECT_EQ(one, places_after(gas(20, 2), 200));
    EXPECT_EQ(one, places_after(gas(20, 1, true), 200));
}

/// Five equal boxes in a row: the first one brings its speed to the last one.
TEST(Stepper, ARowOfBoxesHandsItsSpeedOn) {
    World world({.margin = margin, .restitution = 1});
    const Polyhedron shape = box({0.5, 0.5, 0.5}).polyhedron();
    for (int i = 0; i < 5; ++i) {
        RigidBody body = examples::solid(shape, 1);
        EXPECT_NEAR(body.mass, 1, 1e-15);
        EXPECT_NEAR((body.inertia - Eigen::Matrix3d::Identity() / 6).norm(), 0, 1e-15);
        body.pose.translation().x() = i == 0 ? -1 : 1.01 * i;
        if (i == 0)
            body.velocity.linear.x() = 1;
        world.add("box " + std::to_string(i), shape, body);
    }
    std::vector<double> times;
    world.after_impulses = [&](const StepEvent&) { times.push_back(world.time()); };
    world.step(2);
    ASSERT_EQ(times.size(), 4);
    double time = 1.01 - margin; // from -1 to one side and a margin before 1.01
    for (const double found : times) {
        EXPECT_NEAR(found, time, 1e-11);
        time += 0.01 - margin;
    }
    for (std::size_t i = 0; i < 5; ++i)
        EXPECT_NEAR(world.bodies()[i].velocity.linear.x(), i == 4 ? 1 : 0, 1e-12) << i;
}

struct Pair {
    Scene scene;
    std::size_t moving;
};

/// A small box above a floor with its top at 0.
Pair box_over_floor(double gap, const Vector3d& way) {
    Pair pair;
    pair.scene.add({"floor", box({5, 5, 1}).polyhedron(), Motion::at_rest(shifted(0, 0, -1))});
    const double height = 0.1 + gap;
    const Pose goal(Vector3d(0, 0, height) + way, Eigen::Quaterniond::Identity());
    pair.moving =
        pair.scene.add({"box", box({0.1, 0.1, 0.1}).polyhedron(), Motion::velocity(shifted(0, 0, height), goal)});
    return pair;
}

TEST(Stepper, EventsAreFirstContactsAtTheMargin) {
    const auto [scene, moving] = box_over_floor(0.5, {0.1, 0.2, -1});
    Stepper stepper(scene, {.margin = margin});
    const auto event = stepper.advance();
    ASSERT_TRUE(event);
    EXPECT_NEAR(event->time, 0.5 - margin, 1e-12);
    EXPECT_EQ(stepper.time(), event->time);
    ASSERT_EQ(event->contacts.size(), 1);
    EXPECT_EQ(event->contacts[0].moving, moving);
    EXPECT_EQ(event->contacts[0].contact.contacts.size(), 4); // its corners
    for (const Contact& contact : event->contacts[0].contact.contacts) {
        EXPECT_NEAR(contact.gap, margin, 1e-12);
        EXPECT_NEAR(contact.approach_speed, 1, 1e-9);
        EXPECT_NEAR((contact.normal - Vector3d::UnitZ()).norm(), 0, 1e-9);
    }
    EXPECT_NEAR((stepper.pose(moving).translation - event->time * Vector3d(0.1, 0.2, -1)).z(), 0.6, 1e-12);
}

/// Five equal boxes fall on a floor at the same time, but one of them is stopped on its way.
TEST(Stepper, AnEventTellsAllPairsOfItsTimeAndOnlyThose) {
    Scene scene;
    const Polyhedron shape = box({0.1, 0.1, 0.1}).polyhedron();
    const auto falling = [](double x) { return Motion::velocity(shifted(x, 0, 0.6), shifted(x, 0, -0.4)); };
    const std::size_t stopped = scene.add({"middle", shape, falling(0)});
    for (const int i : {3, 0, 2, 1})
        scene.add({"box " + std::to_string(i), shape, falling(-1 - i)});
    scene.add({"floor", box({5, 5, 1}).polyhedron(), Motion::at_rest(shifted(0, 0, -1))});
    scene.add({"post", box({0.1, 0.1, 0.01}).polyhedron(), Motion::at_rest(shifted(0, 0, 0.2))});
    Stepper stepper(scene, {.margin = margin});
    const auto names = [&](const std::optional<StepEvent>& event) {
        std::vector<std::string> moving;
        for (const SceneContact& pair : event->contacts)
            moving.push_back(scene.bodies()[pair.moving].name);
        return moving;
    };
    EXPECT_EQ(names(stepper.advance()), std::vector<std::string>{"middle"});
    stepper.move(stopped, Motion::at_rest(stepper.pose(stopped)));
    EXPECT_EQ(names(stepper.advance()), (std::vector<std::string>{"box 0", "box 1", "box 2", "box 3"}));
    EXPECT_NEAR(stepper.time(), 0.5 - margin, 1e-12);
}

/// Two boxes pass each other at half of the margin, side along side.
TEST(Stepper, BodiesThatMayOnlyMeetWithinTheMarginDoSo) {
    const double aside = 0.2 + 0.5 * margin;
    const auto along = [](double from, double to, double y) {
        return Motion::velocity(shifted(from, y, 0), shifted(to, y, 0));
    };
    const Polyhedron shape = box({0.1, 0.1, 0.1}).polyhedron();
    Scene scene;
    scene.add({"first", shape, along(-1, 1, 0)});
    scene.add({"second", shape, along(1, -1, aside)});
    const double time = (1.8 - std::sqrt(0.75) * margin) / 4; // the corners are the margin apart
    EXPECT_NEAR(Stepper(scene, {.margin = margin}).advance()->time, time, 1e-12);
    SceneQuery query;
    query.options.margin = margin;
    ASSERT_EQ(scene.first_contact(query).contacts.size(), 1);

    scene.move(0, Motion::at_rest(shifted(-1, 0, 0)));
    scene.move(1, Motion::at_rest(shifted(1, aside, 0)));
    Stepper moved(scene, {.margin = margin});
    moved.move(0, along(-1, 1, 0));
    moved.move(1, along(1, -1, aside));
    const auto event = moved.advance();
    ASSERT_TRUE(event);
    EXPECT_NEAR(event->time, time, 1e-12);
}

TEST(Stepper, WhatIsNearMayMoveOnButNotThrough) {
    const auto [sliding, slides] = box_over_floor(0.3 * margin, {1, 0, 0});
    EXPECT_FALSE(Stepper(sliding, {.margin = margin}).advance());

    const auto [falling, falls] = box_over_floor(0.3 * margin, {1, 0, -1});
    Stepper stepper(falling, {.margin = margin});
    const auto event = stepper.advance();
    ASSERT_TRUE(event);
    EXPECT_NEAR(event->contacts[0].contact.contacts[0].gap, 0.25 * margin, 1e-12);
    stepper.move(falls, Motion::velocity(stepper.pose(falls), shifted(1, 0, 0.1 + 0.25 * margin)));
    EXPECT_FALSE(stepper.advance());
    EXPECT_EQ(stepper.time(), 1);
    EXPECT_NEAR(stepper.pose(falls).translation.x(), 1, 1e-15);
}

TEST(Stepper, ABodyThatIsNotMovedAwayStopsTheStep) {
    const auto [scene, moving] = box_over_floor(0.5, {0, 0, -1});
    Stepper stepper(scene, {.margin = margin});
    int events = 0;
    const std::string message = refusal([&] {
        while (const auto event = stepper.advance()) {
            EXPECT_GT(event->contacts[0].contact.contacts[0].gap, 0);
            ++events;
        }
    });
    EXPECT_EQ(events, 21);
    EXPECT_EQ(message.substr(0, 31), "scene: box on floor: at time 0.");
    EXPECT_LT(stepper.time(), 0.5);
    EXPECT_EQ(refusal([&] {
                  Stepper(box_over_floor(-0.01, {0, 0, 0.1}).scene, {.margin = margin}).advance();
              }),
              "scene: box on floor: at time 0.000000 they are nearer than a millionth of the margin, and cannot go on");
}

/// A tower of boxes: what rests on what is told with the box that is hit.
void expect_connected(double gap, const StepOptions& options) {
    Scene scene;
    const double step = 0.2 + gap;
    const Polyhedron shape = box({0.1, 0.1, 0.1}).polyhedron();
    const auto at = [](double height) { return shifted(0, 0, height); };
    const auto falling = [&](double from, double to) { return Motion::velocity(at(from), at(to)); };
    scene.add({"floor", box({5, 5, 1}).polyhedron(), Motion::at_rest(at(-1))});
    for (int i = 0; i < 3; ++i) { // almost at rest
        const double height = 0.1 + gap + i * step;
        scene.add({"box " + std::to_string(i), shape, falling(height, height - 1e-9)});
    }
    scene.add({"far", shape, Motion::at_rest(shifted(2, 0, 1))});
    scene.add({"hit", shape, falling(2, 0)});
    Stepper stepper(scene, options);
    const auto event = stepper.advance();
    ASSERT_TRUE(event);
    const auto names = [&](const std::vector<SceneContact>& pairs) {
        std::vector<std::string> texts;
        for (const SceneContact& pair : pairs)
            texts.push_back(scene.bodies()[pair.moving].name + " on " + scene.bodies()[pair.fixed].name);
        return texts;
    };
    EXPECT_EQ(names(event->contacts), std::vector<std::string>{"box 2 on hit"});
    EXPECT_EQ(names(event->connected),
              (std::vector<std::string>{"box 0 on box 1", "box 0 on floor", "box 1 on box 2"}));
}

TEST(Stepper, AnEventTellsWhatIsConnected) {
    expect_connected(1.5 * margin, {.margin = margin});
    expect_connected(4 * margin, {.margin = margin, .reach = 5 * margin});
}

/// Four equal boxes fall on a floor, with four margins.
TEST(Stepper, PairsAndGroupsKeepTheirMargins) {
    Scene scene;
    const Polyhedron shape = box({0.1, 0.1, 0.1}).polyhedron();
    scene.add({"floor", box({9, 5, 1}).polyhedron(), Motion::at_rest(shifted(0, 0, -1)), "static"});
    for (int i = 0; i < 4; ++i) {
        const double start = i == 3 ? 0.1 + 0.3 * 0.008 : 0.6;
        scene.add({std::to_string(i), shape, Motion::velocity(shifted(i, 0, start), shifted(i, 0, start - 1)),
                   i == 1 ? "soft" : ""});
    }
    scene.set_group_margin("static", "soft", 0.004);
    scene.set_margin("2", "floor", 0.002);
    scene.set_margin("floor", "3", 0.008);
    Stepper stepper(scene, {.margin = margin});
    const auto expect_event = [&](std::size_t moving, double time, double gap) {
        const auto event = stepper.advance();
        ASSERT_TRUE(event);
        EXPECT_NEAR(event->time, time, 1e-12);
        ASSERT_EQ(event->contacts.size(), 1);
        EXPECT_EQ(event->contacts[0].moving, moving);
        ASSERT_EQ(event->contacts[0].contact.contacts.size(), 4);
        EXPECT_NEAR(event->contacts[0].contact.contacts[0].gap, gap, 1e-12);
        stepper.move(moving, Motion::at_rest(stepper.pose(moving)));
    };
    expect_event(4, 0.05 * 0.008, 0.25 * 0.008); // starts within its margin, and may come half as near
    expect_event(2, 0.5 - 0.004, 0.004);
    expect_event(3, 0.5 - 0.002, 0.002);
    expect_event(1, 0.5 - margin, margin);
    EXPECT_FALSE(stepper.advance());
}

TEST(Stepper, RefusesWhatItCannotUse) {
    const auto [scene, moving] = box_over_floor(0.5, {0, 0, -1});
    EXPECT_EQ(refusal([&] { Stepper(scene, {}); }), "query: margin: must be positive for a step");
    EXPECT_EQ(refusal([&] { Stepper(scene, {.margin = 1, .reach = 1}); }),
              "query: reach: must be at least 1.001 times the margin");
    Scene with_margin = scene;
    with_margin.set_margin("box", "floor", 2 * margin);
    EXPECT_EQ(refusal([&] { Stepper(with_margin, {.margin = margin, .reach = 2 * margin}); }),
              "query: reach: must be at least 1.001 times the margin");
    with_margin.set_group_margin("a", "b", 0);
    EXPECT_EQ(refusal([&] { Stepper(with_margin, {.margin = margin}); }),
              "query: margin: of a pair or a group must be positive for a step");
    Stepper stepper(scene, {.margin = margin});
    EXPECT_EQ(refusal([&] { stepper.move(9, Motion::at_rest(Pose())); }), "scene: body 9: there are 2 bodies");
    EXPECT_EQ(refusal([&] { stepper.move(moving, Motion::at_rest(Pose())); }),
              "scene: box: move: the motion starts 0.600000 away from where the body is");
    EXPECT_EQ(refusal([&] { stepper.move(moving, Motion::screw(Pose(), Pose())); }).substr(0, 37),
              "scene: box: motion: takes no paper's ");
    while (const auto event = stepper.advance())
        stepper.move(moving, Motion::at_rest(stepper.pose(moving)));
    EXPECT_EQ(refusal([&] { stepper.move(moving, Motion::at_rest(Pose())); }), "scene: box: move: the step is over");
}

} // namespace
} // namespace chasles::test
