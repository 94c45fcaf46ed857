// Four lanes of doubles as compiler vectors (the form of the library), through Google Highway, and as a plain array.
// All forms run the same kernels, are checked for equal answers, and are then timed in turns. The benchmark is built
// for plain x86-64 (SSE2) and for AVX2. Decision: docs/decisions/0030-lanes.md.
#include "bench/lanes_cases.h"
#include "bench/lanes_forms.h"
#include "bench/ratio_reporter.h"
#include "bench/run_benchmarks.h"

#include <benchmark/benchmark.h>
#include <cstdio>
#include <cstring>

namespace chasles::bench {
namespace {

constexpr double box_slack = 1e-13;

template <class Pair>
struct Family {
    const char* name;
    std::vector<Pair> pairs;
};

/// Everything is inlined, so that inlining decisions of the compiler do not affect the comparison.
template <class Form, class Pair>
[[gnu::flatten]] std::size_t count_rejected(const PackedMaps<Form>& maps, const std::vector<Pair>& pairs) {
    std::size_t count = 0;
    for (const Pair& pair : pairs)
        count += is_rejected(maps, pair) ? 1 : 0;
    return count;
}

/// Compares the answers of all pairs, and the bits of the heights by which vertex/face pairs are rejected.
template <class Form, class Pair>
bool answers_like_library(const motion::ControlMaps<double>& maps, const Family<Pair>& family) {
    const auto expected_maps = packed<LibraryForm>(maps, box_slack);
    const auto form_maps = packed<Form>(maps, box_slack);
    for (const Pair& pair : family.pairs) {
        if (is_rejected(expected_maps, pair) != is_rejected(form_maps, pair))
            return false;
        if constexpr (std::is_same_v<Pair, VertexAndPlane>) {
            const FourDoubles expected = height(expected_maps, pair).values();
            const FourDoubles found = height(form_maps, pair).values();
            if (std::memcmp(&expected, &found, sizeof expected) != 0)
                return false;
        }
    }
    return true;
}

template <class Form, class Pair>
bool add(const motion::ControlMaps<double>& maps, const Family<Pair>& family) {
    if (!answers_like_library<Form>(maps, family)) {
        std::printf("%s: %s and library give different answers\n", family.name, Form::name);
        return false;
    }
    const auto form_maps = packed<Form>(maps, box_slack);
    const auto rejected = count_rejected(form_maps, family.pairs);
    std::printf("%-18s %-8s equal answers, %zu of %zu pairs rejected\n", family.name, Form::name, rejected,
                family.pairs.size());
    const auto run = [form_maps, &family](benchmark::State& state) {
        for (auto _ : state)
            benchmark::DoNotOptimize(count_rejected(form_maps, family.pairs));
        state.SetItemsProcessed(state.iterations() * std::int64_t(family.pairs.size()));
    };
    benchmark::RegisterBenchmark((std::string(family.name) + "/" + Form::name).c_str(), run);
    return true;
}

template <class Pair>
bool add_forms(const motion::ControlMaps<double>& maps, const Family<Pair>& family) {
    bool equal = add<LibraryForm>(maps, family) && add<ArrayForm>(maps, family);
#if CHASLES_BENCH_HIGHWAY
    equal = equal && add<HighwayForm>(maps, family);
#endif
    return equal;
}

const char* highway_target() {
#if CHASLES_BENCH_HIGHWAY
    return hwy::TargetName(HWY_TARGET);
#else
    return "skipped: libhwy-dev was not found";
#endif
}

bool runs_here() {
#if defined(__AVX2__)
    return __builtin_cpu_supports("avx2") != 0;
#else
    return true;
#endif
}

int run(int argc, char** argv) {
    std::printf("lanes of this build: %s; Highway target: %s\n", CHASLES_BENCH_TARGET, highway_target());
    if (!runs_here()) {
        std::printf("skipped: this processor does not run %s\n", CHASLES_BENCH_TARGET);
        return 0;
    }
    const motion::ControlMaps<double> maps = ten_degree_maps();
    const Family<VertexAndPlane> vertex_face{"vertex_face", vertices_and_planes()};
    const Family<BoxPair> mixed{"boxes_mixed", mixed_boxes()};
    const Family<BoxPair> overlapping{"boxes_overlapping", overlapping_boxes()};
    if (!add_forms(maps, vertex_face) || !add_forms(maps, mixed) || !add_forms(maps, overlapping))
        return 1;
    RatioReporter reporter(LibraryForm::name);
    return run_benchmarks(argc, argv, &reporter);
}

} // namespace
} // namespace chasles::bench

int main(int argc, char** argv) {
    return chasles::bench::run(argc, argv);
}
