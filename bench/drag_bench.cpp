// How long one update of a dragged body takes: hands at 60 Hz that press a body into others and move along.
//
// For each scene it prints the median, the 99th percentile and the slowest update in milliseconds, how many updates
// were in contact, and how many ended before they came to rest. Goals wander around a place where there is much to
// touch.
//
//     drag_bench [--updates=600]
#include "bench/bodies.h"
#include "bench/generated_bodies.h"
#include "bench/timings.h"
#include "chasles/chasles.h"
#include "scenes/threaded_fastener.h"

#include <Eigen/Geometry>
#include <cstdio>
#include <cstdlib>
#include <span>
#include <string_view>

namespace chasles::bench {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

struct Case {
    const char* name;
    Polyhedron moving;
    Polyhedron fixed;
    Pose start;      ///< clear
    Pose home;       ///< around which the hand wanders; the bodies may overlap there
    double way = 0;  ///< of the hand around home, mesh unit
    double turn = 0; ///< likewise, radians
};

/// A smooth hand: sums of slow waves.
Pose goal_at(const Case& hand, double time) {
    const auto wave = [&](double rate, double phase) { return std::sin(rate * time + phase); };
    const Vector3d shift = hand.way * Vector3d(wave(1.3, 0), wave(1.7, 1), wave(0.9, 2));
    const Vector3d axis = hand.turn * Vector3d(wave(0.7, 3), wave(1.1, 4), wave(1.9, 5));
    const double angle = axis.norm();
    const Quaterniond turn(Eigen::AngleAxisd(angle, angle > 0 ? Vector3d(axis / angle) : Vector3d::UnitX()));
    return {hand.home.translation + shift, turn * Quaterniond(hand.home.rotation)};
}

/// The time of a force for another goal, from the contacts of the last update. Microseconds.
void run_forces(const Case& hand, int updates, double friction) {
    Scene scene;
    scene.add({"fixed", hand.fixed});
    scene.add({"moving", hand.moving, Motion::at_rest(hand.start)});
    DragOptions options;
    options.friction = friction;
    DraggedBody body(scene, "moving", options);
    std::vector<double> times;
    std::size_t most_contacts = 0;
    for (int i = 0; i < updates; ++i) {
        const DragStep step = body.update(goal_at(hand, i / 60.0));
        most_contacts = std::max(most_contacts, step.contacts.size());
        for (int k = 0; k < 16 && !step.contacts.empty(); ++k)
            times.push_back(least_microseconds(1, [&] { (void)body.force(goal_at(hand, (i + k / 16.0) / 60)); }));
    }
    if (!times.empty())
        std::printf("  force, us, friction %.1f       %8.1f %8.1f %8.1f   (%zu contacts at most)\n", friction,
                    median(times), quantile(times, 0.99), quantile(times, 1), most_contacts);
}

void run(const Case& hand, int updates) {
    Scene scene;
    scene.add({"fixed", hand.fixed});
    scene.add({"moving", hand.moving, Motion::at_rest(hand.start)});
    DraggedBody body(scene, "moving");
    std::vector<double> times;
    int in_contact = 0, unfinished = 0;
    std::size_t pieces = 0;
    for (int i = 0; i < updates; ++i) {
        const Pose goal = goal_at(hand, i / 60.0);
        DragStep step;
        times.push_back(least_microseconds(1, [&] { step = body.update(goal); }) / 1000);
        in_contact += step.contacts.empty() ? 0 : 1;
        unfinished += step.state == DragState::moving ? 1 : 0;
        pieces += step.pieces.size();
        if (step.state == DragState::touching) {
            std::printf("%s: the bodies touch\n", hand.name);
            std::exit(1);
        }
    }
    std::printf("%-28s %8.3f %8.3f %8.3f %10d %10d %8.2f\n", hand.name, median(times), quantile(times, 0.99),
                quantile(times, 1), in_contact, unfinished, double(pieces) / updates);
    for (const double friction : {0.0, 0.3})
        run_forces(hand, updates, friction);
}

Pose at(double x, double y, double z) {
    return {Vector3d(x, y, z), Quaterniond::Identity()};
}

void run_all(int updates) {
    std::printf("%-28s %8s %8s %8s %10s %10s %8s\n", "update, ms", "median", "99 %", "slowest", "in contact",
                "unfinished", "pieces");
    const Polyhedron box = peg({4, 1, 1});
    run({"box on a plate", box, peg({4, 5, 1}), at(0, 0, 2), at(0, 0, 0.9), 0.3, 0.1}, updates);
    run({"peg of 64 sides in its hole", peg({64, 1, 3}), plate_with_hole({64, 3, 2}, 1.01), at(0, 0, -0.5),
         at(0, 0, -0.5), 0.3, 0.05},
        updates);
    const scenes::ThreadedFastener fastener;
    run({"nut on its bolt", scenes::nut(fastener), scenes::bolt(fastener), at(0, 0, 8), at(0, 0, 8), 0.5, 0.1},
        updates);
    const NamedBody large = large_body();
    const double radius = (large.body.report().upper - large.body.report().lower).norm() / 2;
    run({large.name.c_str(), large.body, large.body, at(3 * radius, 0, 0), at(0.7 * radius, 0, 0), 0.2 * radius, 0.3},
        updates);
    const auto piano = data_file("fcl-pianomover/rob.obj"), house = data_file("fcl-pianomover/env.obj");
    if (!piano || !house)
        return void(std::printf("piano in a house: skipped, the data is missing\n"));
    const Polyhedron moving = Polyhedron::load(*piano, {.triangulate = true});
    const Polyhedron fixed = Polyhedron::load(*house, {.triangulate = true});
    const double size = (moving.report().upper - moving.report().lower).norm();
    // above the house, and pressed down into it
    const Vector3d middle = (fixed.report().lower + fixed.report().upper) / 2;
    const Vector3d own = (moving.report().lower + moving.report().upper) / 2;
    Vector3d above = middle - own, home = middle - own;
    above.z() = fixed.report().upper.z() - moving.report().lower.z() + size;
    home.z() = fixed.report().lower.z() - own.z();
    run({"piano in a house", moving, fixed, Pose(above, Quaterniond::Identity()), Pose(home, Quaterniond::Identity()),
         size, 0.5},
        updates);
}

} // namespace
} // namespace chasles::bench

int main(int argc, char** argv) {
    constexpr std::string_view option = "--updates=";
    int updates = 600;
    for (const std::string_view argument : std::span(argv, std::size_t(argc)).subspan(1))
        if (argument.starts_with(option)) // options of Google Benchmark are for the other programs
            updates = std::max(1, std::atoi(argument.substr(option.size()).data()));
    chasles::bench::run_all(updates);
    return 0;
}
