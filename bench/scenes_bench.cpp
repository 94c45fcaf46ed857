// Scenes of many bodies beside FCL's DynamicAABBTreeCollisionManager: the exact earliest contact and yes or no, against
// one discrete pass, and against 10 samples of the step. Bodies of a thousand triangles lie in a loose grid; in a step
// each moves by a tenth of its size and turns by 10 degrees. The spacing of the grid decides how many boxes overlap.
// Bodies that would touch another one during the step are put elsewhere, so that the scene is clear; then a few of them
// may touch, but not at the start. Each time is the least of several. Our tree of bodies is built anew for each
// question, and FCL's is refitted, as its users do.
#include "bench/bodies.h"
#include "bench/draw.h"
#include "bench/fcl_scene.h"
#include "bench/generated_bodies.h"
#include "bench/timings.h"
#include "chasles/chasles.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <malloc.h>
#include <numbers>

namespace chasles::bench {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

struct Step {
    Pose start;
    Pose goal;
};

/// A scene for both libraries.
struct Bodies {
    Polyhedron shape;
    Vector3d centre;
    std::vector<Step> steps;

    [[nodiscard]] Motion motion(std::size_t i) const { return Motion::velocity(steps[i].start, steps[i].goal, centre); }
};

/// Whether two bodies touch during the step, or at the start of it.
bool touch(const Bodies& bodies, std::size_t a, std::size_t b, double until) {
    Scene pair;
    pair.add({"a", bodies.shape, bodies.motion(a)});
    pair.add({"b", bodies.shape, bodies.motion(b)});
    return pair.first_contact({.until = until, .threads = 1}).verdict != Verdict::clear;
}

/// `spacing` is the distance of the cells of the grid over the size of a body. One in a thousand may touch others, but
/// not at the start, if `may_touch`.
Bodies bodies_in_a_grid(std::size_t count, double spacing, bool may_touch) {
    constexpr double degree = std::numbers::pi / 180;
    Bodies bodies{bumpy_torus(22, 23), {}, {}};
    Eigen::AlignedBox3d box;
    for (const Vector3d& vertex : bodies.shape.vertices())
        box.extend(vertex);
    bodies.centre = box.center();
    const double size = box.sizes().maxCoeff();
    const auto side = std::size_t(std::ceil(std::cbrt(double(count))));
    Draw draw(19);
    while (bodies.steps.size() < count) {
        const std::size_t i = bodies.steps.size();
        const std::array<std::size_t, 3> at{i % side, i / side % side, i / side / side};
        const Vector3d cell = Vector3d(double(at[0]), double(at[1]), double(at[2]));
        const Vector3d from = spacing * size * cell + 0.05 * size * draw.direction();
        const Vector3d to = from + 0.1 * size * draw.direction();
        const Quaterniond start = draw.turn(0, std::numbers::pi);
        const Quaterniond goal = Quaterniond(Eigen::AngleAxisd(10 * degree, draw.direction())) * start;
        bodies.steps.push_back({Pose(from - start * bodies.centre, start), Pose(to - goal * bodies.centre, goal)});
        const double until = may_touch && i % 1000 == 500 ? 0 : 1;
        bool is_free = true;
        for (std::size_t x = 0; x < 27 && is_free; ++x) { // neighbours that are placed already
            const std::array<std::size_t, 3> other{at[0] + x % 3, at[1] + x / 3 % 3, at[2] + x / 9};
            if (std::ranges::any_of(other, [&](std::size_t c) { return c == 0 || c > side; }))
                continue;
            const std::size_t neighbour = other[0] - 1 + side * (other[1] - 1 + side * (other[2] - 1));
            is_free = neighbour >= i || !touch(bodies, i, neighbour, until);
        }
        if (!is_free)
            bodies.steps.pop_back();
    }
    return bodies;
}

Scene scene_of(const Bodies& bodies) {
    Scene scene;
    for (std::size_t i = 0; i < bodies.steps.size(); ++i)
        scene.add({"body " + std::to_string(i), bodies.shape, bodies.motion(i)});
    return scene;
}

double milliseconds(int calls, const auto& work) {
    return least_microseconds(calls, work) / 1000;
}

/// Heap memory in use, bytes.
double memory_in_use() {
    const auto memory = mallinfo2();
    return double(memory.uordblks) + double(memory.hblkhd);
}

/// What a user pays once a step: a motion for each body.
double time_of_moves(const Bodies& bodies, Scene& scene) {
    return milliseconds(1, [&] {
        for (std::size_t i = 0; i < bodies.steps.size(); ++i)
            scene.move(i, bodies.motion(i));
    });
}

void print_scene(std::size_t count, double spacing, bool may_touch, bool with_fcl) {
    const Bodies bodies = bodies_in_a_grid(count, spacing, may_touch);
    const double before = memory_in_use();
    Scene scene = scene_of(bodies);
    const double bytes = (memory_in_use() - before) / double(count);
    const double moves = time_of_moves(bodies, scene);
    SceneQuery any{.threads = 1};
    any.options.find = Find::any;
    const SceneAnswer answer = scene.first_contact({.threads = 1});
    const int calls = count <= 10'000 ? 5 : 2;
    const double first = milliseconds(calls, [&] { (void)scene.first_contact({.threads = 1}).verdict; });
    const double two = milliseconds(calls, [&] { (void)scene.first_contact({.threads = 2}).verdict; });
    const double yes = milliseconds(calls, [&] { (void)scene.first_contact(any).verdict; });
    std::printf(
        "%7zu bodies of %4.0f bytes, spacing %.2f: %-8s %7zu pairs  moves %7.2f ms  first %9.2f ms  two threads "
        "%4.2f  any %9.2f ms",
        count, bytes, spacing, answer.contacts.empty() ? "clear" : "contact", answer.pairs, moves, first, first / two,
        yes);
    if (with_fcl) {
        FclScene fcl(scene);
        double sample = 0;
        const double pass = milliseconds(calls, [&] { (void)fcl.collides_at(0); });
        const double ten = milliseconds(calls, [&] { sample = fcl.first_sample(10); });
        std::printf("  FCL: a pass %9.2f ms (%zu pairs), 10 samples %9.2f ms; ours over FCL's: first / samples %5.2f, "
                    "any / pass %5.2f%s",
                    pass, fcl.pairs(), ten, first / ten, yes / pass,
                    !answer.contacts.empty() && sample > 1 ? ", FCL misses it" : "");
        if (sample <= 1 && (answer.contacts.empty() || answer.contacts[0].contact.time.lower > sample))
            std::printf("  DISAGREE: FCL says %.17g", sample);
    }
    std::printf("\n");
    std::fflush(stdout);
}

int run() {
    for (const double spacing : {0.95, 1.2})
        for (const bool may_touch : {false, true})
            for (const std::size_t count : {100U, 1000U, 10'000U, 100'000U})
                print_scene(count, spacing, may_touch, count <= 10'000);
    return 0;
}

} // namespace
} // namespace chasles::bench

int main() {
    return chasles::bench::run();
}
