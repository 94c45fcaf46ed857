// Planning problems of MotionBenchMaker for the Panda, as MoveIt writes them in YAML.
#pragma once

#include "chasles/robot/robot.h"
#include "chasles/scene/scene.h"

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace chasles::test {

struct PlanningProblem {
    std::string name;
    Scene world;                                              ///< boxes, and cylinders enclosed by polyhedra
    std::vector<std::pair<std::string, std::string>> allowed; ///< links that are not tested against each other
    Configuration start;
    Configuration goal;
};

/// The names of all problems below a folder, sorted.
std::vector<std::string> planning_problem_names(const std::filesystem::path& folder);
/// Reads "box/0001", for example.
PlanningProblem read_planning_problem(const std::filesystem::path& folder, const std::string& name, const Robot& robot);

} // namespace chasles::test
