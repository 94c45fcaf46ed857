// The Panda in the worlds of its planning problems, from the folder robots/panda of real inputs.
#pragma once

#include "bench/random_edges.h"
#include "chasles/robot/robot.h"
#include "tests/data/planning_scenes.h"

#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

namespace chasles::bench {

/// Calls visit(robot, problem) for this many of the problems, evenly chosen. False, with a message, without the folder.
template <class Visit>
bool for_each_panda_world(std::size_t count, const Visit& visit) {
    const std::filesystem::path folder = std::filesystem::path(CHASLES_DATA_DIR) / "robots/panda";
    if (!std::filesystem::exists(folder)) {
        std::printf("skipped: no folder robots/panda of real inputs\n");
        return false;
    }
    const Robot robot = Robot::load(folder / "panda.urdf", {.srdf = folder / "panda.srdf"});
    const std::vector<std::string> names = test::planning_problem_names(folder / "mbm-problems");
    for (std::size_t i = 0; i < count; ++i)
        visit(robot, test::read_planning_problem(folder / "mbm-problems", names[i * names.size() / count], robot));
    return true;
}

/// A way in joint space of this length, measured as the sum of the ways of all joints, radians.
inline Configuration random_way(Draw& draw, const Robot& robot, double length) {
    const Configuration way = random_within_limits(draw, robot) - random_within_limits(draw, robot);
    return way * (length / way.lpNorm<1>());
}

} // namespace chasles::bench
