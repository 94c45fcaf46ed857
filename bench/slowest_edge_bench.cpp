// The slowest edges of the Panda in the worlds of its planning problems: the first contact along a million random
// edges, most of which touch something, many of them at the start.
#include "bench/panda_worlds.h"
#include "bench/timings.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>

namespace {

using namespace chasles;
using namespace chasles::bench;

constexpr std::size_t problems = 400;
constexpr int further_runs = 2; ///< of edges that seem slow: the machine may have paused
constexpr double slow = 5000;   ///< microseconds

struct Times {
    std::vector<double> all;
    std::size_t contacts = 0, at_start = 0, not_certain = 0;
};

void measure(Times& times, const RobotChecker& checker, const Configuration& start, const Configuration& goal) {
    RobotAnswer found;
    const auto ask = [&] { found = checker.first_contact(start, goal); };
    double taken = least_microseconds(1, ask);
    if (taken > slow)
        taken = std::min(taken, least_microseconds(further_runs, ask));
    times.all.push_back(taken);
    times.contacts += found.verdict != Verdict::clear;
    times.at_start += found.verdict == Verdict::contact_at_start;
    times.not_certain += found.verdict != Verdict::clear && !found.certain;
}

void print(double length, const Times& times) {
    std::printf("%zu edges of %.0f rad in all joints together: %zu touch, %zu of them at the start; %zu not certain\n",
                times.all.size(), length, times.contacts, times.at_start, times.not_certain);
    std::printf("  median %.1f us, 99 %% %.0f, 99.99 %% %.0f, slowest %.0f\n", quantile(times.all, 0.5),
                quantile(times.all, 0.99), quantile(times.all, 0.9999), quantile(times.all, 1));
}

} // namespace

int main(int argc, char** argv) {
    const std::size_t edges = argc > 1 ? std::strtoul(argv[1], nullptr, 10) : 1'000'000;
    for (const double length : {1.0, 5.0}) {
        Draw draw(23);
        Times times;
        const auto measure_world = [&](const Robot& robot, const test::PlanningProblem& problem) {
            const RobotChecker checker(robot, &problem.world);
            for (std::size_t i = 0; i < edges / problems; ++i) {
                const Configuration start = random_within_limits(draw, robot);
                measure(times, checker, start, start + random_way(draw, robot, length));
            }
        };
        if (!for_each_panda_world(problems, measure_world))
            return 0;
        print(length, times);
        std::fflush(stdout);
    }
}
