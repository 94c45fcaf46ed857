// Whole queries: two bodies of 69,000 triangles that move half a body length into contact, one step of a nut on its
// bolt, and the loading of a body. Every answer is checked before it is timed.
#include "bench/motion_cases.h"
#include "bench/run_benchmarks.h"
#include "chasles/mesh/body.h"

#include <benchmark/benchmark.h>
#include <cstdio>
#include <memory>

namespace chasles::bench {
namespace {

void time_query(benchmark::State& state, const MotionCase& test, Find find) {
    FirstContact found;
    for (auto _ : state) {
        found = answer(test, find);
        benchmark::DoNotOptimize(found);
    }
    state.counters["node_pairs"] = double(found.work.node_pairs);
    state.counters["face_pairs"] = double(found.work.face_pairs);
    state.counters["elementary"] = double(found.work.elementary_tests);
    state.counters["contact_at"] = found.time.lower;
    state.counters["bracket"] = found.time.upper - found.time.lower;
}

/// Returns false and prints a line if the answer is wrong.
bool add(const MotionCase& test) {
    const std::string reason = contradiction(test);
    std::printf("%-14s %s\n", test.name.c_str(), reason.empty() ? "checked" : reason.c_str());
    if (!reason.empty())
        return false;
    for (const auto& [name, find] : {std::pair("first", Find::first), std::pair("any", Find::any)})
        benchmark::RegisterBenchmark((test.name + "/" + name).c_str(), [test, find = find](benchmark::State& state) {
            time_query(state, test, find);
        })->Unit(benchmark::kMillisecond);
    return true;
}

std::vector<std::vector<std::uint32_t>> outlines_of(const Polyhedron& body) {
    std::vector<std::vector<std::uint32_t>> outlines;
    for (std::size_t face = 0; face < body.face_count(); ++face)
        outlines.emplace_back(body.face(face).begin(), body.face(face).end());
    return outlines;
}

void add_loading(const NamedBody& body) {
    const auto report = [](benchmark::State& state, const Polyhedron& made) {
        const double triangles = double(made.report().triangles);
        state.counters["triangles"] = triangles;
        state.counters["bytes_a_triangle"] = double(made.memory()) / triangles;
        state.counters["hierarchy_bytes_a_triangle"] = double(made.body().bvh().memory()) / triangles;
    };
    if (const auto file = data_file("meshes/stanford-bunny.obj"))
        benchmark::RegisterBenchmark("bunny/load_file", [file, report](benchmark::State& state) {
            for (auto _ : state)
                benchmark::DoNotOptimize(Polyhedron::load(*file));
            report(state, Polyhedron::load(*file));
        })->Unit(benchmark::kMillisecond);
    benchmark::RegisterBenchmark((body.name + "/from_polygons").c_str(), [&body, report](benchmark::State& state) {
        const auto outlines = outlines_of(body.body);
        for (auto _ : state)
            benchmark::DoNotOptimize(Polyhedron::from_polygons(body.body.vertices(), outlines));
        report(state, body.body);
    })->Unit(benchmark::kMillisecond);
}

int run(int argc, char** argv) {
    const NamedBody body = large_body();
    const std::optional<NutAndBolt> nut = m16_nut_and_bolt();
    bool right = true;
    for (const MotionCase& test : into_contact(body))
        right = add(test) && right;
    if (nut)
        right = add(nut_step(*nut)) && right;
    if (!right)
        return 1;
    add_loading(body);
    return run_benchmarks(argc, argv);
}

} // namespace
} // namespace chasles::bench

int main(int argc, char** argv) {
    return chasles::bench::run(argc, argv);
}
