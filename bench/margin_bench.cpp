// The cost of a margin: the same motions without a margin, and with margins from a millionth to a tenth of the body's
// size. The answers are compared with each other before they are timed.
#include "bench/bodies.h"
#include "bench/run_benchmarks.h"
#include "chasles/chasles.h"
#include "chasles/mesh/body.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <benchmark/benchmark.h>
#include <cstdio>
#include <random>

namespace chasles::bench {
namespace {

/// A body and a copy of it: motions that start beside the body, move half through it, and turn by 17 degrees.
struct MarginCase {
    NamedBody body;
    std::vector<Motion> motions;
    double size; ///< diameter of the body
};

MarginCase case_of(NamedBody body) {
    const double radius = body.body.body().bvh().radius();
    const Eigen::Vector3d centre = body.body.body().bvh().centre();
    std::mt19937_64 random(5);
    std::normal_distribution<double> normal;
    const auto direction = [&] {
        const double x = normal(random), y = normal(random);
        return Eigen::Vector3d(Eigen::Vector3d(x, y, normal(random)).normalized());
    };
    const auto around_centre = [&](const Eigen::Quaterniond& turn, const Eigen::Vector3d& place) {
        return Pose{centre - turn * centre + place, turn};
    };
    std::vector<Motion> motions;
    for (int i = 0; i < 24; ++i) {
        const double w = normal(random), x = normal(random), y = normal(random);
        const Eigen::Quaterniond turn = Eigen::Quaterniond(w, x, y, normal(random)).normalized();
        const Eigen::Vector3d from = direction();
        const Eigen::Quaterniond further = Eigen::Quaterniond(Eigen::AngleAxisd(0.3, direction())) * turn;
        motions.push_back(
            ScrewMotion::between(around_centre(turn, 2.2 * radius * from),
                                 around_centre(further, 0.9 * radius * from + 0.2 * radius * direction())));
    }
    return {std::move(body), std::move(motions), 2 * radius};
}

FirstContact answer(const MarginCase& test, const Motion& motion, double share, Find find) {
    return first_contact({.moving = test.body.body,
                          .fixed = test.body.body,
                          .motion = motion,
                          .options = {.margin = share * test.size, .find = find}});
}

constexpr double margins[] = {0, 1e-6, 1e-4, 1e-3, 1e-2, 1e-1};

/// Whether every larger margin is reached at the same time or earlier.
bool is_in_order(const MarginCase& test) {
    for (const Motion& motion : test.motions) {
        double last = 1;
        for (const double share : margins) {
            const FirstContact found = answer(test, motion, share, Find::first);
            const double time = found.verdict == Verdict::clear ? 1 : found.time.lower;
            if (time > last || !found.certain)
                return false;
            last = time;
        }
    }
    return true;
}

void time_margin(benchmark::State& state, const MarginCase& test, double share, Find find) {
    Work work;
    for (auto _ : state)
        for (const Motion& motion : test.motions)
            work += answer(test, motion, share, find).work;
    const double queries = double(state.iterations()) * double(test.motions.size());
    state.counters["us_a_query"] =
        benchmark::Counter(1e-6 * queries, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
    state.counters["node_pairs"] = double(work.node_pairs) / queries;
    state.counters["elementary"] = double(work.elementary_tests) / queries;
}

int run(int argc, char** argv) {
    std::vector<MarginCase> cases;
    cases.push_back(case_of({"torus 4k", bumpy_torus(61, 30)}));
    cases.push_back(case_of({"torus 59k", bumpy_torus(243, 122)}));
    cases.push_back(case_of(large_body()));
    for (const MarginCase& test : cases) {
        if (!is_in_order(test)) {
            std::printf("%s: a larger margin is reached later, or an answer is uncertain\n", test.body.name.c_str());
            return 1;
        }
        std::printf("%s: checked\n", test.body.name.c_str());
        for (const auto& [name, find] : {std::pair("first", Find::first), std::pair("any", Find::any)})
            for (const double share : margins)
                benchmark::RegisterBenchmark(
                    (test.body.name + "/" + name + "/margin " + std::to_string(share)).c_str(),
                    [&test, share, find = find](benchmark::State& state) { time_margin(state, test, share, find); })
                    ->Unit(benchmark::kMillisecond);
    }
    return run_benchmarks(argc, argv);
}

} // namespace
} // namespace chasles::bench

int main(int argc, char** argv) {
    return chasles::bench::run(argc, argv);
}
