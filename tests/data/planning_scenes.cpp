#include "tests/data/planning_scenes.h"

#include "chasles/base/invalid_input.h"
#include "chasles/mesh/primitives.h"

#include <algorithm>
#include <yaml-cpp/yaml.h>

namespace chasles::test {

namespace {

using Eigen::Vector3d;

Pose pose_of(const YAML::Node& node) {
    const auto p = node["position"].as<std::vector<double>>();
    const auto q = node["orientation"].as<std::vector<double>>();
    return {Vector3d(p.at(0), p.at(1), p.at(2)), Eigen::Quaterniond(q.at(3), q.at(0), q.at(1), q.at(2))};
}

/// The cylinder is polygonal, and by a hundredth of its radius too thick.
Polyhedron shape_of(const YAML::Node& node) {
    const auto type = node["type"].as<std::string>();
    const auto sizes = node["dimensions"].as<std::vector<double>>();
    if (type == "box")
        return make_box({sizes.at(0), sizes.at(1), sizes.at(2)});
    if (type == "cylinder") // height and radius
        return enclosing_cylinder(sizes.at(1), sizes.at(0), 0.01 * sizes.at(1)).shape;
    throw InvalidInput("primitive " + type + ": is unknown");
}

void set(Configuration& values, const Robot& robot, const std::string& joint, double value) {
    const auto variables = robot.variables();
    const auto found = std::ranges::find(variables, joint, &RobotVariable::name);
    if (found != variables.end()) // the fingers of this robot are fixed
        values[found - variables.begin()] = value;
}

} // namespace

std::vector<std::string> planning_problem_names(const std::filesystem::path& folder) {
    std::vector<std::string> names;
    for (const auto& kind : std::filesystem::directory_iterator(folder))
        for (const auto& file : std::filesystem::directory_iterator(kind))
            if (const std::string stem = file.path().stem().string(); stem.starts_with("scene"))
                names.push_back(kind.path().filename().string() + "/" + stem.substr(5));
    std::ranges::sort(names);
    return names;
}

PlanningProblem read_planning_problem(const std::filesystem::path& folder, const std::string& name,
                                      const Robot& robot) {
    const std::string kind = name.substr(0, name.find('/')), number = name.substr(name.find('/') + 1);
    const YAML::Node scene = YAML::LoadFile(folder / kind / ("scene" + number + ".yaml"));
    const YAML::Node request = YAML::LoadFile(folder / kind / ("request" + number + ".yaml"));
    PlanningProblem problem{name, {}, {}, robot.neutral(), robot.neutral()};
    for (const YAML::Node& object : scene["world"]["collision_objects"])
        for (std::size_t i = 0; i < object["primitives"].size(); ++i)
            problem.world.add({object["id"].as<std::string>() + (i > 0 ? "/" + std::to_string(i) : ""),
                               shape_of(object["primitives"][i]),
                               Motion::at_rest(pose_of(object["primitive_poses"][i]))});
    const YAML::Node matrix = scene["allowed_collision_matrix"];
    const auto links = matrix["entry_names"].as<std::vector<std::string>>();
    for (std::size_t i = 0; i < links.size(); ++i)
        for (std::size_t j = i + 1; j < links.size(); ++j)
            if (matrix["entry_values"][i][j].as<bool>())
                problem.allowed.emplace_back(links[i], links[j]);
    const YAML::Node start = request["start_state"]["joint_state"];
    for (std::size_t i = 0; i < start["name"].size(); ++i)
        set(problem.start, robot, start["name"][i].as<std::string>(), start["position"][i].as<double>());
    for (const YAML::Node& joint : request["goal_constraints"][0]["joint_constraints"])
        set(problem.goal, robot, joint["joint_name"].as<std::string>(), joint["position"].as<double>());
    return problem;
}

} // namespace chasles::test
