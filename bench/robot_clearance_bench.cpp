// How near the Panda comes in the worlds of its planning problems, along edges of one radian: the bracket that is
// proven, beside the least of FCL's distances at samples of the edge. No sample may be nearer than the proven bound.
#include "bench/fcl_robot.h"
#include "bench/panda_worlds.h"
#include "bench/timings.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace {

using namespace chasles;
using namespace chasles::bench;

constexpr int problems = 40; // of 400
constexpr int edges_of_problem = 10;
constexpr int samples_of_edge = 10;
/// FCL's distances are rounded by about so much.
constexpr double rounding_of_peer = 1e-7;

struct Totals {
    std::vector<double> proven, contact, sampled; ///< milliseconds
    std::vector<double> excess;                   ///< of the least sample over the least distance, of that distance
    int edges = 0, wide = 0, denied = 0;
};

void measure(Totals& totals, const RobotChecker& checker, FclRobot& peer, const Configuration& start,
             const Configuration& goal) {
    RobotClearance found;
    totals.contact.push_back(1e-3 * least_microseconds(1, [&] { (void)checker.first_contact(start, goal); }));
    totals.proven.push_back(1e-3 * least_microseconds(1, [&] { found = checker.least_distance(start, goal); }));
    std::vector<FclRobot::Poses> poses;
    for (int i = 0; i <= samples_of_edge; ++i)
        poses.push_back(peer.poses(start + (double(i) / samples_of_edge) * (goal - start)));
    double least = INFINITY;
    totals.sampled.push_back(1e-3 * least_microseconds(1, [&] {
                                 for (const FclRobot::Poses& pose : poses)
                                     least = std::min(least, peer.distance(pose));
                             }));
    ++totals.edges;
    totals.wide += !found.certain;
    totals.denied += least < found.distance.lower - rounding_of_peer;
    if (found.distance.upper > 0)
        totals.excess.push_back(least / found.distance.upper - 1);
}

void print(const char* name, const std::vector<double>& values) {
    std::printf("  %-34s median %8.3f ms, 95 %% %8.3f, slowest %8.2f\n", name, quantile(values, 0.5),
                quantile(values, 0.95), quantile(values, 1));
}

} // namespace

int main() {
    Draw draw(21);
    Totals totals;
    const auto measure_world = [&](const Robot& robot, const test::PlanningProblem& problem) {
        const RobotChecker checker(robot, &problem.world);
        FclRobot peer(robot, problem.world);
        for (int i = 0; i < edges_of_problem;) {
            const Configuration start = random_within_limits(draw, robot);
            const Configuration goal = start + random_way(draw, robot, 1);
            if (!checker.is_clear(start, goal))
                continue;
            measure(totals, checker, peer, start, goal);
            ++i;
        }
    };
    if (!for_each_panda_world(problems, measure_world))
        return 0;
    std::printf("%d edges of 1 rad that touch nothing\n", totals.edges);
    print("least distance, proven", totals.proven);
    print("first contact, proven", totals.contact);
    print("FCL's distance at 11 samples", totals.sampled);
    std::printf("  brackets wider than 1e-6 of the distance: %d; samples nearer than proven: %d\n", totals.wide,
                totals.denied);
    std::printf("  the least sample is farther than the least distance by: median %.2g %%, 95 %% %.2g, most %.3g\n",
                100 * quantile(totals.excess, 0.5), 100 * quantile(totals.excess, 0.95),
                100 * quantile(totals.excess, 1));
}
