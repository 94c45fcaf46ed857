// The time of a profile beside that of a least distance, and whether FCL's distances lie within its bounds. Asked are
// pairs on motions of all kinds, scenes, and the Panda in its worlds.
//
//     profile_bench [MOTIONS [PATHS [POSES]]]
#include "bench/bodies.h"
#include "bench/draw.h"
#include "bench/fcl_distance.h"
#include "bench/fcl_robot.h"
#include "bench/generated_bodies.h"
#include "bench/panda_worlds.h"
#include "bench/timings.h"
#include "chasles/chasles.h"
#include "chasles/mesh/body.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

namespace chasles::bench {
namespace {

using Eigen::Vector3d;

/// Of FCL's distances, relative to the sizes of the bodies; of those to spheres and capsules, mesh unit.
constexpr double fcl_rounding = 1e-9;
constexpr double fcl_error_of_robots = 1e-5;

struct Judged {
    std::size_t poses = 0;
    std::size_t below = 0; ///< the lower bound
    std::size_t above = 0; ///< the upper bound

    void compare(const DistanceProfile& profile, double time, double distance, double error) {
        const auto after = std::ranges::upper_bound(profile.times, time);
        const auto step = std::size_t(std::max<std::ptrdiff_t>(after - profile.times.begin(), 1) - 1);
        ++poses;
        below += distance < profile.lower[step] - error ? 1 : 0;
        above += distance > profile.upper[step] + error ? 1 : 0;
    }
};

struct Times {
    std::vector<double> least, profile, ratio, ratio_apart, steps; ///< the fourth of those where nothing touches

    void add(double of_least, double of_profile, const DistanceProfile& found) {
        if (found.free().size() == 1 && found.free().front().upper - found.free().front().lower == 1)
            ratio_apart.push_back(of_profile / of_least);
        least.push_back(of_least);
        profile.push_back(of_profile);
        ratio.push_back(of_profile / of_least);
        steps.push_back(double(found.times.size() - 1));
    }
    void print(const std::string& name, const Judged& judged, std::size_t wide) const {
        std::printf("%-30s %6zu %10.1f %10.1f %7.1f %7.1f %6zu %7.1f %7.1f %8.0f %6zu %10zu %6zu %6zu\n", name.c_str(),
                    ratio.size(), median(least), median(profile), median(ratio), quantile(ratio, 0.9),
                    ratio_apart.size(), median(ratio_apart), quantile(ratio_apart, 0.9), median(steps), wide,
                    judged.poses, judged.below, judged.above);
        std::fflush(stdout);
    }
};

void print_head() {
    std::printf("%-30s %6s %10s %10s %7s %7s %6s %7s %7s %8s %6s %10s %6s %6s\n", "family", "asked", "least, us",
                "prof., us", "ratio", "90 %", "apart", "ratio", "90 %", "steps", "wide", "poses", "below", "above");
}

Pose random_pose(Draw& draw, double size) {
    return {size * draw.between(0, 1) * draw.direction(), draw.turn(0, 3)};
}

/// Motions of one body past another one; lengths count in radii.
Motion random_motion(Draw& draw, int kind, double radius) {
    const Pose start = random_pose(draw, 3 * radius), goal = random_pose(draw, 3 * radius);
    const Motion away = Motion::at_rest(random_pose(draw, 2 * radius));
    switch (kind) {
    case 0:
        return Motion::screw(start, goal);
    case 1:
        return Motion::sweep(start, goal);
    case 2:
        return Motion::velocity(start, goal);
    case 3:
        return Motion::twist(start, goal);
    case 4:
        return Motion::hinge(radius * draw.direction(), draw.direction(), {0, draw.between(0, 3)}) * away;
    case 5:
        return relative(Motion::velocity(start, goal), Motion::twist(goal, random_pose(draw, 3 * radius)));
    default:
        return Motion::spline({0, 0.5, 1}, {start, goal, random_pose(draw, 3 * radius)});
    }
}

constexpr const char* kinds[] = {"screw", "sweep", "velocity", "twist", "hinge", "both move", "spline"};

void run_pairs(const NamedBody& a, const NamedBody& b, std::size_t count, int poses) {
    const double radius = a.body.body().bvh().radius();
    const FclDistance peer(a.body, b.body);
    Draw draw(45);
    for (int kind = 0; kind < int(std::size(kinds)); ++kind) {
        Times times;
        Judged judged;
        std::size_t wide = 0;
        for (std::size_t i = 0; i < count; ++i) {
            const Motion motion = random_motion(draw, kind, radius);
            DistanceProfile found;
            const double least = least_microseconds(2, [&] { (void)least_distance({a.body, b.body, motion, {}}); });
            const double of_profile = least_microseconds(2, [&] { found = profile({a.body, b.body, motion, {}}); });
            times.add(least, of_profile, found);
            wide += found.certain ? 0 : 1;
            for (int k = 0; k < poses; ++k) {
                const double time = (k + 0.5) / poses;
                judged.compare(found, time, peer.at(motion, time), fcl_rounding * radius);
            }
        }
        times.print(a.name + " by " + b.name + ", " + kinds[kind], judged, wide);
    }
}

void run_scenes(std::size_t bodies, std::size_t count) {
    Draw draw(46);
    const Polyhedron shapes[] = {ellipsoid({1, 0.7, 0.5}, 1), peg({6, 0.6, 1.5}), bumpy_torus(13, 8)};
    Times times;
    std::size_t wide = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const double size = 2.5 * std::cbrt(double(bodies)) + 1;
        Scene scene;
        for (std::size_t k = 0; k < bodies; ++k)
            scene.add({std::to_string(k), shapes[k % 3],
                       k % 3 == 0 ? Motion::at_rest(random_pose(draw, size))
                                  : Motion::velocity(random_pose(draw, size), random_pose(draw, size))});
        SceneProfile found;
        const double least = least_microseconds(2, [&] { (void)scene.least_distance(); });
        const double of_profile = least_microseconds(2, [&] { found = scene.profile(); });
        times.add(least, of_profile, found.distance);
        wide += found.distance.certain ? 0 : 1;
    }
    times.print("scene of " + std::to_string(bodies), {}, wide);
}

/// Paths of three straight edges.
void run_paths(std::size_t count, int poses) {
    Draw draw(47);
    Times times;
    Judged judged;
    std::size_t wide = 0;
    const std::size_t worlds = std::min<std::size_t>(count, 50), paths_of_each = std::max<std::size_t>(1, count / 50);
    for_each_panda_world(worlds, [&](const Robot& robot, const auto& problem) {
        const RobotChecker checker(robot, &problem.world);
        FclRobot peer(robot, problem.world);
        for (std::size_t i = 0; i < paths_of_each; ++i) {
            std::vector<Configuration> knots{random_within_limits(draw, robot)};
            while (knots.size() < 4)
                knots.push_back(knots.back() + random_way(draw, robot, 0.7));
            const JointPath path = JointPath::straight(robot, knots);
            RobotProfile found;
            const double least = least_microseconds(2, [&] { (void)checker.least_distance(path); });
            const double of_profile = least_microseconds(2, [&] { found = checker.profile(path); });
            times.add(least, of_profile, found.distance);
            wide += found.distance.certain ? 0 : 1;
            for (int k = 0; k < poses; ++k) {
                const double stamp = 3 * (k + 0.5) / poses;
                const double distance = std::max(0.0, peer.distance(peer.poses(path.at(stamp))));
                judged.compare(found.distance, stamp, distance, fcl_error_of_robots);
            }
        }
    });
    times.print("panda, three edges", judged, wide);
}

} // namespace
} // namespace chasles::bench

int main(int count, char** arguments) {
    using namespace chasles::bench;
    const auto argument = [&](int i, std::size_t usual) {
        return count > i ? std::size_t(std::max(0L, std::atol(arguments[i]))) : usual;
    };
    const std::size_t motions = argument(1, 140), paths = argument(2, 20);
    const int poses = int(argument(3, 100));
    const NamedBody bodies[] = {{"ellipsoid", ellipsoid({1, 0.7, 0.5}, 1)}, {"torus", bumpy_torus(13, 8)}};
    print_head();
    run_pairs(bodies[0], bodies[0], motions / 14, poses);
    run_pairs(bodies[1], bodies[0], motions / 14, poses);
    for (const std::size_t size : {4, 8, 16})
        run_scenes(size, paths);
    run_paths(paths, poses);
}
