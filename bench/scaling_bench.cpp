// Growth of time and memory with the number of triangles of both bodies (for one relative motion), and of the
// throughput with the number of threads (for many motions). Answers are checked before they are timed.
#include "bench/bodies.h"
#include "bench/draw.h"
#include "bench/run_benchmarks.h"
#include "chasles/base/flat_lists.h"
#include "chasles/mesh/body.h"
#include "chasles/query/batch.h"

#include <Eigen/Geometry>
#include <benchmark/benchmark.h>
#include <cmath>
#include <cstdio>
#include <map>
#include <numbers>

namespace chasles::bench {
namespace {

using Eigen::AngleAxisd;
using Eigen::Quaterniond;
using Eigen::Vector3d;

/// Two bumpy tori, one of them upright. The moving torus moves along x with a small turn, from 0.02 before the contact
/// to 0.02 after it (contact) or to 0.01 before it (clear).
struct Approach {
    Polyhedron body;
    Vector3d touching;

    explicit Approach(std::size_t sides) : body(bumpy_torus(sides, sides)) {
        const FirstContact straight =
            first_contact({.moving = body,
                           .fixed = body,
                           .motion = ScrewMotion::between(Pose(Vector3d(4, 0.1, 0.2), upright()),
                                                          Pose(Vector3d(0, 0.1, 0.2), upright()))});
        touching = Vector3d(4 * (1 - straight.time.lower), 0.1, 0.2);
    }

    [[nodiscard]] FirstContact ask(Find find, bool reaches) const {
        const Quaterniond turned = Quaterniond(AngleAxisd(0.01, Vector3d::UnitX())) * upright();
        const auto at = [&](double before) { return Vector3d(touching + Vector3d(before, 0, 0)); };
        return first_contact(
            {.moving = body,
             .fixed = body,
             .motion = ScrewMotion::between(Pose(at(0.02), upright()), Pose(at(reaches ? -0.02 : 0.01), turned)),
             .options = {.find = find}});
    }

    static Quaterniond upright() { return Quaterniond(AngleAxisd(std::numbers::pi / 2, Vector3d::UnitX())); }
};

/// Made at the first call for each size. Each torus has 2 * sides^2 triangles.
const Approach& approach(std::int64_t triangles) {
    static std::map<std::int64_t, Approach> made;
    const auto sides = std::size_t(std::lround(std::sqrt(double(triangles) / 2)));
    return made.try_emplace(triangles, sides).first->second;
}

const std::vector<std::int64_t> sizes = {1'000, 4'000, 16'000, 64'000, 256'000, 1'000'000};

bool is_right() {
    for (const std::int64_t triangles : sizes) {
        const Approach& pair = approach(triangles);
        const FirstContact first = pair.ask(Find::first, true);
        if (first.verdict != Verdict::contact || std::abs(first.time.lower - 0.5) > 0.05 ||
            pair.ask(Find::any, true).verdict != Verdict::contact ||
            pair.ask(Find::first, false).verdict != Verdict::clear) {
            std::printf("%lld triangles: the verdict is not the expected one\n", static_cast<long long>(triangles));
            return false;
        }
    }
    return true;
}

void time_query(benchmark::State& state, Find find, bool reaches) {
    const Approach& pair = approach(state.range(0));
    FirstContact found;
    for (auto _ : state) {
        found = pair.ask(find, reaches);
        benchmark::DoNotOptimize(found);
    }
    state.counters["node_pairs"] = double(found.work.node_pairs);
    state.SetComplexityN(state.range(0));
}

void time_build(benchmark::State& state) {
    const Polyhedron& body = approach(state.range(0)).body;
    FlatLists<std::uint32_t> outlines;
    for (std::size_t face = 0; face < body.face_count(); ++face)
        outlines.append(body.face(face));
    for (auto _ : state)
        benchmark::DoNotOptimize(Bvh(outlines, body.vertices(), unsigned(state.range(1))));
    state.SetItemsProcessed(state.iterations() * std::int64_t(body.face_count()));
    state.counters["bytes_a_triangle"] = double(body.body().bvh().memory()) / double(body.face_count());
}

void add_growth() {
    const auto add = [](const char* name, Find find, bool reaches) {
        benchmark::RegisterBenchmark(name, [=](benchmark::State& state) { time_query(state, find, reaches); })
            ->ArgsProduct({sizes})
            ->Unit(benchmark::kMicrosecond)
            ->Complexity([](benchmark::IterationCount n) { return std::sqrt(double(n)); });
    };
    add("growth/first", Find::first, true);
    add("growth/any", Find::any, true);
    add("growth/clear", Find::first, false);
    benchmark::RegisterBenchmark("hierarchy", time_build)
        ->ArgNames({"", "threads"})
        ->ArgsProduct({sizes, {1, 2}})
        ->UseRealTime()
        ->Unit(benchmark::kMillisecond);
}

/// FCL's robot in its room, or two tori of 5,800 triangles if the data is missing.
struct ManyMotions {
    Polyhedron moving = bumpy_torus(54, 54);
    Polyhedron fixed = moving;
    std::vector<Motion> motions;

    ManyMotions() {
        double room = 2.5;
        const auto robot = data_file("fcl-pianomover/rob.obj");
        const auto walls = data_file("fcl-pianomover/env.obj");
        if (robot && walls) {
            moving = Polyhedron::load(*robot);
            fixed = Polyhedron::load(*walls);
            room = 3000;
        } else {
            std::printf("skipped: fcl-pianomover is missing; two bumpy tori are used instead\n");
        }
        Draw draw(8);
        const auto place = [&] {
            return Vector3d(draw.between(-room, room), draw.between(-room, room), draw.between(0, room));
        };
        for (int i = 0; i < 10'000; ++i) {
            const Vector3d from = place();
            const Quaterniond turn = draw.turn(0, std::numbers::pi);
            const Vector3d to = from + 0.3 * (place() - from);
            motions.emplace_back(
                ScrewMotion::between(Pose(from, turn), Pose(to, draw.turn(0, 0.3 * std::numbers::pi) * turn)));
        }
    }

    [[nodiscard]] std::vector<FirstContact> ask(unsigned threads) const {
        return first_contact_batch(
            {.moving = moving, .fixed = fixed, .motions = motions, .batch = {.threads = threads}});
    }
};

bool is_right(const ManyMotions& many) {
    const auto one = many.ask(1);
    const auto two = many.ask(2);
    for (std::size_t i = 0; i < one.size(); ++i)
        if (one[i].verdict != two[i].verdict || one[i].time.lower != two[i].time.lower) {
            std::printf("motion %zu: one thread and two threads disagree\n", i);
            return false;
        }
    return true;
}

void add_batch(const ManyMotions& many) {
    for (const unsigned threads : {1U, 2U})
        benchmark::RegisterBenchmark(("batch/" + std::to_string(threads) + "_threads").c_str(),
                                     [&many, threads](benchmark::State& state) {
                                         for (auto _ : state)
                                             benchmark::DoNotOptimize(many.ask(threads));
                                         state.SetItemsProcessed(state.iterations() *
                                                                 std::int64_t(many.motions.size()));
                                     })
            ->UseRealTime()
            ->Unit(benchmark::kMillisecond);
}

int run(int argc, char** argv) {
    static const ManyMotions many;
    if (!is_right() || !is_right(many))
        return 1;
    add_growth();
    add_batch(many);
    return run_benchmarks(argc, argv);
}

} // namespace
} // namespace chasles::bench

int main(int argc, char** argv) {
    return chasles::bench::run(argc, argv);
}
