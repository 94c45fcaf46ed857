// Edges of a planner for the Panda in the worlds of its planning problems: proven, beside FCL's discrete tests of
// samples as OMPL's validator takes them, at 1 % of the largest distance in joint space (its default) and at 0.1 %. FCL
// gets the poses of all samples made beforehand.
#include "bench/fcl_robot.h"
#include "bench/panda_worlds.h"
#include "bench/timings.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace {

using namespace chasles;
using namespace chasles::bench;

constexpr int problems = 40; // of 400
constexpr int edges_of_problem = 50;

/// The largest distance of two configurations, as OMPL measures it.
double largest_distance(const Robot& robot) {
    double sum = 0;
    for (const RobotVariable& v : robot.variables())
        sum += (v.upper - v.lower) * (v.upper - v.lower);
    return std::sqrt(sum);
}

struct Edge {
    double proven = 0;               ///< microseconds
    std::array<double, 2> sampled{}; ///< likewise
    std::array<bool, 2> sampled_clear{};
    bool is_clear = false;
};

void print(const char* name, const std::vector<Edge>& edges) {
    const auto column = [&](const char* label, const auto& select, const auto& value) {
        std::vector<double> values;
        for (const Edge& edge : edges)
            if (select(edge))
                values.push_back(value(edge));
        double sum = 0;
        for (const double v : values)
            sum += v;
        std::printf("  %-34s %6zu edges: median %8.1f us, mean %8.1f, 95 %% %8.1f, slowest %8.0f\n", label,
                    values.size(), quantile(values, 0.5), sum / double(std::max<std::size_t>(1, values.size())),
                    quantile(values, 0.95), quantile(values, 1));
    };
    const auto all = [](const Edge&) { return true; };
    const auto free = [](const Edge& e) { return e.is_clear; };
    const auto touching = [](const Edge& e) { return !e.is_clear; };
    std::printf("%s\n", name);
    column("proven, all", all, [](const Edge& e) { return e.proven; });
    column("proven, free", free, [](const Edge& e) { return e.proven; });
    column("proven, touching", touching, [](const Edge& e) { return e.proven; });
    constexpr std::array labels{"FCL at 1 %", "FCL at 0.1 %"};
    for (std::size_t k = 0; k < labels.size(); ++k) {
        column((std::string(labels[k]) + ", all").c_str(), all, [k](const Edge& e) { return e.sampled[k]; });
        column((std::string(labels[k]) + ", free").c_str(), free, [k](const Edge& e) { return e.sampled[k]; });
        std::size_t missed = 0, contacts = 0, false_alarms = 0;
        std::vector<double> ratios;
        for (const Edge& edge : edges) {
            contacts += !edge.is_clear;
            missed += !edge.is_clear && edge.sampled_clear[k];
            false_alarms += edge.is_clear && !edge.sampled_clear[k];
            ratios.push_back(edge.proven / edge.sampled[k]);
        }
        std::printf("  %-34s misses %zu of %zu contacts, alarms at %zu free edges; our time is %.2f of its (median)\n",
                    labels[k], missed, contacts, false_alarms, quantile(ratios, 0.5));
    }
}

/// Steps between samples as OMPL counts them, without the start.
int samples_of(const Configuration& way, double step) {
    return std::max(1, int(std::ceil(way.norm() / step)));
}

Edge measured(const RobotChecker& checker, FclRobot& peer, const Configuration& start, const Configuration& way,
              double extent) {
    Edge edge;
    std::vector<double> times;
    for (int run = 0; run < 3; ++run)
        times.push_back(least_microseconds(1, [&] { edge.is_clear = checker.is_clear(start, start + way); }));
    edge.proven = quantile(times, 0.5);
    constexpr std::array parts{0.01, 0.001};
    for (std::size_t k = 0; k < parts.size(); ++k) {
        const int count = samples_of(way, parts[k] * extent);
        std::vector<FclRobot::Poses> poses;
        for (int i = 1; i <= count; ++i)
            poses.push_back(peer.poses(start + way * (double(i) / count)));
        times.clear();
        for (int run = 0; run < 3; ++run)
            times.push_back(least_microseconds(1, [&] {
                edge.sampled_clear[k] =
                    std::ranges::none_of(poses, [&](const auto& pose) { return peer.collides(pose); });
            }));
        edge.sampled[k] = quantile(times, 0.5);
    }
    return edge;
}

} // namespace

int main() {
    for (const double length : {1.0, 3.0}) {
        Draw draw(20);
        std::vector<Edge> edges;
        const auto measure_world = [&](const Robot& robot, const test::PlanningProblem& problem) {
            const RobotChecker checker(robot, &problem.world);
            FclRobot peer(robot, problem.world);
            for (int i = 0; i < edges_of_problem;) {
                const Configuration start = random_within_limits(draw, robot);
                if (!checker.is_clear(start) || peer.collides(start))
                    continue;
                edges.push_back(
                    measured(checker, peer, start, random_way(draw, robot, length), largest_distance(robot)));
                ++i;
            }
        };
        if (!for_each_panda_world(problems, measure_world))
            return 0;
        char title[80];
        std::snprintf(title, sizeof title, "edges of %.0f rad in all joints together, from free configurations",
                      length);
        print(title, edges);
    }
}
