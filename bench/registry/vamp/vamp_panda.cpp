// VAMP's Panda (spheres), its clouds, validator of edges and RRT-Connect, for Python's ctypes: vamp_robot.py.
// Built by install.sh from the headers of the source package vamp-planner.
#include <algorithm>
#include <chrono>
#include <memory>
#include <vamp/collision/factory.hh>
#include <vamp/collision/filter.hh>
#include <vamp/planning/rrtc.hh>
#include <vamp/planning/simplify.hh>
#include <vamp/planning/validate.hh>
#include <vamp/random/halton.hh>
#include <vamp/robots/panda.hh>

namespace {

using Robot = vamp::robots::Panda;
constexpr std::size_t rake = vamp::FloatVectorWidth;
using Given = vamp::collision::Environment<float>;
using World = vamp::collision::Environment<vamp::FloatVector<rake>>;
using Planner = vamp::planning::RRTC<Robot, rake, Robot::resolution>;
using Clock = std::chrono::steady_clock;

struct Panda {
    Given given;
    World world;
};

Robot::Configuration configuration(const double* values) {
    Robot::ConfigurationArray array;
    std::copy(values, values + Robot::dimension, array.begin());
    return Robot::Configuration(array);
}

double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

} // namespace

extern "C" {

Panda* vamp_new() {
    return new Panda;
}
void vamp_delete(Panda* panda) {
    delete panda;
}

/// Centre, angles about x, y and z, half sizes.
void vamp_add_cuboid(Panda* panda, const float* c, const float* angles, const float* half) {
    panda->given.cuboids.push_back(vamp::collision::factory::cuboid::flat(c[0], c[1], c[2], angles[0], angles[1],
                                                                          angles[2], half[0], half[1], half[2]));
}
void vamp_add_capsule(Panda* panda, const float* c, const float* angles, float radius, float length) {
    panda->given.capsules.push_back(vamp::collision::factory::capsule::center::flat(
        c[0], c[1], c[2], angles[0], angles[1], angles[2], radius, length));
}
/// A cloud of points with a radius, as VAMP's scripts make it: thinned by its own filter to the least radius of the
/// robot's spheres. Returns how many points are left.
int vamp_add_cloud(Panda* panda, const float* coordinates, int count, float radius) {
    std::vector<vamp::collision::Point> points;
    for (int i = 0; i < count; ++i)
        points.push_back({coordinates[3 * i], coordinates[3 * i + 1], coordinates[3 * i + 2]});
    const vamp::collision::Point origin{0, 0, 0};
    const auto kept = vamp::collision::filter_pointcloud(points, Robot::min_radius, 10, origin, origin, origin, false);
    panda->given.pointclouds.emplace_back(kept, Robot::min_radius, Robot::max_radius, radius);
    return int(kept.size());
}
/// After all obstacles.
void vamp_ready(Panda* panda) {
    panda->given.sort();
    panda->world = World(panda->given);
}

/// Whether an edge is valid. The time is the mean of all runs.
bool vamp_is_clear(const Panda* panda, const double* start, const double* goal, int runs, double* seconds) {
    const Robot::Configuration from = configuration(start), to = configuration(goal);
    bool is_clear = false;
    const auto began = Clock::now();
    for (int run = 0; run < runs; ++run)
        is_clear = vamp::planning::validate_motion<Robot, rake, Robot::resolution>(from, to, panda->world);
    *seconds = seconds_since(began) / runs;
    return is_clear;
}

/// Plans, shortens with default settings, and writes at most `room` configurations. Returns their number; 0: unsolved.
int vamp_plan(const Panda* panda, const double* start, const double* goal, double* path, int room, double* seconds) {
    const auto random = std::make_shared<vamp::rng::Halton<Robot>>();
    const auto began = Clock::now();
    const auto planned = Planner::solve(configuration(start), configuration(goal), panda->world, {}, random);
    if (planned.path.empty())
        return 0;
    const auto shortened =
        vamp::planning::simplify<Robot, rake, Robot::resolution>(planned.path, panda->world, {}, random);
    *seconds = seconds_since(began);
    const int count = std::min(room, int(shortened.path.size()));
    for (int i = 0; i < count; ++i) {
        const auto values = shortened.path[i].to_array();
        std::copy(values.begin(), values.begin() + Robot::dimension, path + i * Robot::dimension);
    }
    return count;
}
}
