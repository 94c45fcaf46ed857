#include "bench/drag_cases.h"

#include "bench/bodies.h"
#include "bench/generated_bodies.h"
#include "chasles/base/invalid_input.h"
#include "scenes/maze.h"
#include "scenes/spur_gear.h"
#include "scenes/threaded_fastener.h"

#include <Eigen/Geometry>
#include <cmath>
#include <utility>

namespace chasles::bench {

namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;
using Found = std::optional<DragCase>;

Pose at(double x, double y, double z) {
    return {Vector3d(x, y, z), Quaterniond::Identity()};
}

double diagonal(const Polyhedron& body) {
    return (body.report().upper - body.report().lower).norm();
}

Found box_on_a_plate() {
    return DragCase{"", peg({4, 1, 1}), peg({4, 5, 1}), at(0, 0, 2), at(0, 0, 0.9), 0.3, 0.1};
}

/// The hand goes through the plate and back.
Found box_at_a_thin_plate() {
    return DragCase{"", peg({4, 1, 1}), peg({4, 5, 0.02}), at(0, 0, 1), at(0, 0, 0), 3, 0.5};
}

Found peg_in_its_hole() {
    return DragCase{"", peg({64, 1, 3}), plate_with_hole({64, 3, 2}, 1.01), at(0, 0, -0.5), at(0, 0, -0.5), 0.3, 0.05};
}

Found nut_on_its_bolt() {
    const scenes::ThreadedFastener fastener;
    return DragCase{"", scenes::nut(fastener), scenes::bolt(fastener), at(0, 0, 8), at(0, 0, 8), 0.5, 0.1};
}

Found gear_at_a_gear() {
    const scenes::SpurGear size;
    const Polyhedron gear = scenes::spur_gear(size);
    const double angle = scenes::meshing_angle(size);
    const Pose meshing(Vector3d(2 * size.pitch_radius(), 0, 0),
                       Quaterniond(Eigen::AngleAxisd(angle, Vector3d::UnitZ())));
    return DragCase{"", gear, gear, meshing, meshing, 0.5, 0.3};
}

Found key_in_a_maze() {
    const scenes::Maze size;
    const Vector3d middle = scenes::middle_of(size, {0, 0});
    const Pose home(middle, Quaterniond::Identity());
    // the bit points along a corridor
    const Vector3d way = scenes::middle_of(size, scenes::way_out(size)[1]) - middle;
    const Quaterniond turn(Eigen::AngleAxisd(std::atan2(way.y(), way.x()) + EIGEN_PI, Vector3d::UnitZ()));
    return DragCase{
        "", scenes::maze_key(size), scenes::maze(size), Pose(middle + 0.1 * way, turn), Pose(middle, turn), 6, 0.5};
}

Found two_large_bodies() {
    const Polyhedron body = large_body().body;
    const double radius = diagonal(body) / 2;
    return DragCase{"", body, body, at(3 * radius, 0, 0), at(0.7 * radius, 0, 0), 0.2 * radius, 0.3};
}

/// From above the house, and pressed down into it.
Found piano_in_a_house() {
    const auto piano = data_file("fcl-pianomover/rob.obj"), house = data_file("fcl-pianomover/env.obj");
    if (!piano || !house)
        return {};
    const Polyhedron moving = Polyhedron::load(*piano, {.triangulate = true});
    const Polyhedron fixed = Polyhedron::load(*house, {.triangulate = true});
    const double size = diagonal(moving);
    const Vector3d own = (moving.report().lower + moving.report().upper) / 2;
    Vector3d above = (fixed.report().lower + fixed.report().upper) / 2 - own, home = above;
    above.z() = fixed.report().upper.z() - moving.report().lower.z() + size;
    home.z() = fixed.report().lower.z() - own.z();
    return DragCase{"",   moving, fixed, Pose(above, Quaterniond::Identity()), Pose(home, Quaterniond::Identity()),
                    size, 0.5};
}

/// Bodies of assembly-factory, in metres, whose assembled state is the origin.
Found assembly(const std::string& moving, const std::string& fixed, double raised, double way, double turn) {
    const auto first = data_file("assembly-factory/factory_" + moving + ".obj");
    const auto second = data_file("assembly-factory/factory_" + fixed + ".obj");
    if (!first || !second)
        return {};
    return DragCase{"",  Polyhedron::load(*first), Polyhedron::load(*second), at(0, 0, raised), at(0, 0, raised), way,
                    turn};
}

Found round_peg(const std::string& kind) {
    return assembly("round_peg_16mm_" + kind, "round_hole_16mm_subdiv_3x", 0, 2e-3, 0.05);
}

Found rectangular_peg(const std::string& kind) {
    return assembly("rectangular_peg_16mm_" + kind + "_subdiv_3x", "rectangular_hole_16mm_subdiv_3x", 0, 2e-3, 0.05);
}

struct Entry {
    std::string_view name;
    Found (*make)();
};

constexpr Entry entries[] = {
    {"box on a plate", box_on_a_plate},
    {"box at a thin plate", box_at_a_thin_plate},
    {"peg of 64 sides in its hole", peg_in_its_hole},
    {"nut on its bolt", nut_on_its_bolt},
    {"gear at a gear", gear_at_a_gear},
    {"key in a maze", key_in_a_maze},
    {"bunny on bunny", two_large_bodies},
    {"piano in a house", piano_in_a_house},
    {"round peg, loose", [] { return round_peg("loose"); }},
    {"round peg, tight", [] { return round_peg("tight"); }},
    {"rectangular peg, loose", [] { return rectangular_peg("loose"); }},
    {"rectangular peg, tight", [] { return rectangular_peg("tight"); }},
    // raised to where the thread is free
    {"M16 nut, loose", [] { return assembly("nut_m16_loose_subdiv_3x", "bolt_m16_loose", 0.97 * 0.002, 5e-4, 0.1); }},
    {"M12 nut, tight",
     [] { return assembly("nut_m12_tight_subdiv_3x", "bolt_m12_tight", 0.9275 * 0.00175, 5e-4, 0.1); }},
};

} // namespace

std::vector<std::string_view> drag_case_names() {
    std::vector<std::string_view> names;
    for (const Entry& entry : entries)
        names.push_back(entry.name);
    return names;
}

std::optional<DragCase> drag_case(std::string_view name) {
    for (const Entry& entry : entries)
        if (entry.name == name) {
            Found found = entry.make();
            if (found)
                found->name = name;
            return found;
        }
    throw InvalidInput("drag case: unknown name");
}

Pose goal_at(const DragCase& hand, double time) {
    const auto wave = [&](double rate, double phase) { return std::sin(rate * time + phase); };
    const Vector3d shift = hand.way * Vector3d(wave(1.3, 0), wave(1.7, 1), wave(0.9, 2));
    const Vector3d axis = hand.turn * Vector3d(wave(0.7, 3), wave(1.1, 4), wave(1.9, 5));
    const double angle = axis.norm();
    const Quaterniond turn(Eigen::AngleAxisd(angle, angle > 0 ? Vector3d(axis / angle) : Vector3d::UnitX()));
    return {hand.home.translation + shift, turn * Quaterniond(hand.home.rotation)};
}

} // namespace chasles::bench
