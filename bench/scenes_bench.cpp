// Scenes of many bodies beside other libraries: the exact earliest contact and yes or no, against FCL's and Coal's
// DynamicAABBTreeCollisionManager (one discrete pass, and 10 samples of the step), a step of Bullet's world with
// continuous collision detection, and Parry's tree of boxes with a nonlinear cast of each pair. Bodies of a thousand
// triangles lie in a loose grid; in a step each moves by a tenth of its size and turns by 10 degrees. The spacing of
// the grid decides how many boxes overlap. Bodies that would touch another one during the step are put elsewhere, so
// that the scene is clear. In a second scene a few of them may touch, but not at the start. Missed contacts and false
// alarms are counted against our proven answers. Our tree of bodies is built anew for each question, and those of the
// managers are refitted, as their users do.
//
//     scenes_bench [--spacing=SIZES] [COUNT...]
#include "bench/bodies.h"
#if defined(CHASLES_BENCH_BULLET)
#include "bench/bullet_scene.h"
#endif
#include "bench/draw.h"
#include "bench/fcl_scene.h"
#include "bench/generated_bodies.h"
#include "bench/pair_sets.h"
#include "bench/peer_scene.h"
#include "bench/registry_peers.h"
#include "bench/timings.h"
#include "chasles/chasles.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <malloc.h>
#include <numbers>
#include <span>
#include <string_view>
#include <vector>

namespace chasles::bench {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

/// Of a step, at which the managers test the bodies.
constexpr int samples = 10;

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

/// Heap memory in use, bytes.
double memory_in_use() {
    const auto memory = mallinfo2();
    return double(memory.uordblks) + double(memory.hblkhd);
}

/// What a user pays once a step: a motion for each body.
double time_of_moves(const Bodies& bodies, Scene& scene) {
    return least_microseconds(1,
                              [&] {
                                  for (std::size_t i = 0; i < bodies.steps.size(); ++i)
                                      scene.move(i, bodies.motion(i));
                              }) /
           1000;
}

using Work = std::function<void()>;

/// The least time of each work, in milliseconds. They take turns, as the machine may have other work.
std::vector<double> least_times(const std::vector<Work>& works) {
    constexpr int fewest = 5;
    constexpr double enough = 2000;
    std::vector<double> least(works.size(), 1e300);
    double all = 0;
    for (int call = 0; call < fewest || all < enough; ++call)
        for (std::size_t i = 0; i < works.size(); ++i) {
            const double time = least_microseconds(1, works[i]) / 1000;
            least[i] = std::min(least[i], time);
            all += time;
        }
    return least;
}

/// A row of another library.
void print_peer(const char* name, double time, const PairSet& found, const PairSet& touching) {
    std::printf("    %-34s %9.2f ms  missed %zu of %zu, false alarms %zu\n", name, time, count_missing(touching, found),
                touching.size(), count_missing(found, touching));
}

PairSet pairs_of(const SceneAnswer& answer) {
    PairSet pairs;
    for (const SceneContact& contact : answer.contacts)
        pairs.insert(std::minmax(contact.moving, contact.fixed));
    return pairs;
}

/// The first samples of a step.
PairSet found_by_samples(FclScene& fcl, int count) {
    PairSet found;
    for (int i = 0; i < count; ++i)
        for (const auto& pair : fcl.overlaps_at(double(i) / (samples - 1)))
            found.insert(pair);
    return found;
}

#if defined(CHASLES_BENCH_BULLET)
void print_bullet(const Bodies& bodies, const Scene& scene, const PairSet& touching) {
    constexpr int calls = 3;
    BulletScene bullet(scene, bodies.centre);
    std::vector<double> times;
    for (int call = 0; call < calls; ++call) {
        bullet.reset();
        times.push_back(least_microseconds(1, [&] { bullet.step(); }) / 1000);
    }
    print_peer("Bullet: a step of its world, CCD", *std::ranges::min_element(times), bullet.contacts(), touching);
}
#else
void print_bullet(const Bodies&, const Scene&, const PairSet&) {
    std::printf("    Bullet is absent\n");
}
#endif

/// The rows of a scene in a process, or why there are none. `rows` prints them.
template <class Rows>
void print_process(const char* name, const std::string& absent_because, const std::vector<std::string>& command,
                   const Bodies& bodies, Rows rows) {
    if (!absent_because.empty()) {
        std::printf("    %s is absent: %s\n", name, absent_because.c_str());
        return;
    }
    try {
        PeerScene scene(command, bodies.shape);
        rows(scene);
    } catch (const ChildFailed& failure) {
        std::printf("    %s failed: %s\n", name, failure.what());
    }
}

void print_coal(const Bodies& bodies, const Scene& scene, const PairSet& touching) {
    const PythonPeers python = python_peers();
    const auto rows = [&](PeerScene& coal) {
        coal.place(scene, 0);
        const PeerScene::Pass first = coal.pass();
        PairSet found;
        double all = 0;
        for (int i = 0; i < samples; ++i) {
            coal.place(scene, double(i) / (samples - 1));
            const PeerScene::Pass pass = coal.pass();
            found.insert(pass.found.begin(), pass.found.end());
            all += pass.milliseconds;
        }
        print_peer("Coal's manager: a pass", first.milliseconds, first.found, touching);
        print_peer("Coal's manager: 10 samples", all, found, touching);
    };
    print_process("Coal", python.absent_because, {python.interpreter, python.scripts + "/coal_scene.py"}, bodies, rows);
}

/// Scenes of more bodies are not asked: this one takes 84 s.
void print_parry(const Bodies& bodies, const Scene& scene, const PairSet& touching) {
    constexpr std::size_t most_bodies = 1000;
    if (bodies.steps.size() > most_bodies)
        return;
    const RustPeers rust = rust_peers();
    const auto rows = [&](PeerScene& parry) {
        parry.place(scene, 0);
        parry.place(scene, 1);
        const PeerScene::Pass pass = parry.pass();
        print_peer("Parry's tree and nonlinear casts", pass.milliseconds, pass.found, touching);
    };
    print_process("Parry", rust.absent_because, {rust.program, "scene"}, bodies, rows);
}

void print_peers(const Bodies& bodies, const Scene& scene, const SceneQuery& any) {
    FclScene fcl(scene);
    double sample = 0;
    const std::vector<double> times = least_times(
        {[&] { (void)scene.first_contact({.threads = 1}).verdict; }, [&] { (void)scene.first_contact(any).verdict; },
         [&] { (void)fcl.collides_at(0); }, [&] { sample = fcl.first_sample(samples); }});
    const PairSet touching = pairs_of(scene.all_contacts());
    std::printf(
        "    in turns: first %.2f ms, any %.2f ms; first over FCL's 10 samples %.2f, any over FCL's pass %.2f\n",
        times[0], times[1], times[0] / times[3], times[1] / times[2]);
    print_peer("FCL's manager: a pass", times[2], found_by_samples(fcl, 1), touching);
    print_peer("FCL's manager: 10 samples", times[3], found_by_samples(fcl, samples), touching);
    const SceneAnswer answer = scene.first_contact();
    if (sample <= 1 && (answer.contacts.empty() || answer.contacts[0].contact.time.lower > sample))
        std::printf("    DISAGREE: FCL says %.17g\n", sample);
    print_bullet(bodies, scene, touching);
    print_coal(bodies, scene, touching);
    print_parry(bodies, scene, touching);
}

void print_scene(std::size_t count, double spacing, bool may_touch) {
    const Bodies bodies = bodies_in_a_grid(count, spacing, may_touch);
    const double before = memory_in_use();
    Scene scene = scene_of(bodies);
    const double bytes = (memory_in_use() - before) / double(count);
    const double moves = time_of_moves(bodies, scene);
    const auto ask = [&](unsigned threads, Find find) {
        return [&scene, threads, find] {
            SceneQuery query{.threads = threads};
            query.options.find = find;
            (void)scene.first_contact(query).verdict;
        };
    };
    const SceneAnswer answer = scene.first_contact({.threads = 1});
    const std::vector<double> times =
        least_times({ask(1, Find::first), ask(2, Find::first), ask(1, Find::any), ask(2, Find::any)});
    std::printf(
        "%7zu bodies of %4.0f bytes, spacing %.2f: %-8s %7zu pairs  moves %7.2f ms  first %9.2f ms, two threads "
        "%4.2f  any %9.2f ms, two threads %4.2f\n",
        count, bytes, spacing, answer.contacts.empty() ? "clear" : "contact", answer.pairs, moves, times[0],
        times[0] / times[1], times[2], times[2] / times[3]);
    SceneQuery any{.threads = 1};
    any.options.find = Find::any;
    if (count <= 10'000)
        print_peers(bodies, scene, any);
    std::fflush(stdout);
}

int run(std::span<char* const> arguments) {
    std::vector<std::size_t> counts;
    std::vector<double> spacings{0.95, 1.2};
    for (const std::string_view argument : arguments)
        if (argument.starts_with("--spacing="))
            spacings = {std::atof(argument.substr(10).data())};
        else
            counts.push_back(std::strtoull(argument.data(), nullptr, 10));
    if (counts.empty())
        counts = {100, 1000, 10'000, 100'000};
    for (const double spacing : spacings)
        for (const bool may_touch : {false, true})
            for (const std::size_t count : counts)
                print_scene(count, spacing, may_touch);
    return 0;
}

} // namespace
} // namespace chasles::bench

int main(int argc, char** argv) {
    return chasles::bench::run(std::span(argv, std::size_t(argc)).subspan(1));
}
