#include "cli/robot_question.h"

#include "chasles/io/text_scan.h"
#include "cli/joint_trajectory.h"
#include "cli/report.h"

namespace chasles::cli {
namespace {

/// The rows of a file. A robot without variables stays as it is if there is none.
robot::ConfigurationRows read_path(const Robot& robot, const std::string& file) {
    if (!file.empty())
        return load_joint_path(file, robot);
    if (robot.variables().empty())
        return {.configurations = {robot.neutral(), robot.neutral()}, .stamps = {}};
    std::string names;
    for (const RobotVariable& variable : robot.variables())
        names += (names.empty() ? "" : ", ") + variable.name;
    throw InvalidInput("--path: is needed for the " + counted(robot.variables().size(), "variable") +
                       " of the robot: " + names);
}

} // namespace

std::optional<SceneFile> read_scene(const RobotCommand& options) {
    if (options.scene.empty())
        return std::nullopt;
    const std::optional<double> margin =
        options.query.margin.empty() ? std::nullopt : std::optional(options_of(options.query).margin);
    SceneFile scene =
        load_scene(options.scene,
                   {.triangulate = true, .solid = options.robot.solid, .radius = options.robot.radii.second}, margin);
    if (scene.ignores_touching_at_start)
        throw InvalidInput(io::one_line(options.scene) +
                           ": ignore_touching_at_start: is not for robots; leave it out, and name what a robot may "
                           "touch by --allow LINK,BODY");
    return scene;
}

QueryOptions query_of(const RobotCommand& options, const std::optional<SceneFile>& scene) {
    QuestionOptions question = options.query;
    if (options.query.margin.empty())
        question.margin = "0";
    QueryOptions query = options_of(question);
    if (scene && options.query.margin.empty())
        query.margin = scene->margin;
    if (scene && options.query.hold.empty())
        query.hold = scene->hold;
    return query;
}

Robot read_robot(const RobotCommand& options, const std::optional<SceneFile>& scene,
                 std::vector<std::string>& warnings) {
    Robot robot = load_robot(options.robot);
    warnings = robot.warnings();
    const PolyhedronOptions attached{
        .triangulate = true, .solid = options.robot.solid, .radius = options.robot.radii.first};
    change(robot, scene ? &scene->scene : nullptr, options.changes, attached, warnings);
    return robot;
}

namespace {

/// What a scene's file says that has no effect on distances.
void warn_of_margins(const RobotCommand& options, const SceneFile& scene, std::vector<std::string>& warnings) {
    if (!options.finds_clearance && !options.finds_profile)
        return;
    const std::string has_no_effect =
        options.finds_profile ? " has no effect on a profile" : " has no effect on a clearance";
    if (scene.margin > 0)
        warnings.push_back(io::one_line(options.scene) + ": margin" + has_no_effect);
    if (scene.hold)
        warnings.push_back(io::one_line(options.scene) + ": hold" + has_no_effect);
}

} // namespace

RobotQuestion read_question(const RobotCommand& options) {
    (void)query_of(options, std::nullopt); // what is wrong with an option comes first
    std::optional<SceneFile> scene = read_scene(options);
    const QueryOptions query = query_of(options, scene);
    std::vector<std::string> warnings;
    Robot robot = read_robot(options, scene, warnings);
    robot::ConfigurationRows rows = read_path(robot, options.path);
    if (scene) {
        warnings.insert(warnings.end(), scene->warnings.begin(), scene->warnings.end());
        warn_of_margins(options, *scene, warnings);
    }
    warnings.insert(warnings.end(), rows.warnings.begin(), rows.warnings.end());
    for (std::string& warning : robot.warnings_about(rows.configurations))
        warnings.push_back("path: " + std::move(warning));
    return {std::move(robot), std::move(rows), std::move(scene), query, std::move(warnings), options.path};
}

JointPath path_of(const RobotQuestion& question) {
    const robot::ConfigurationRows& rows = question.rows;
    try {
        return question.has_stamps() ? JointPath::straight(question.robot, rows.configurations, rows.stamps)
                                     : JointPath::straight(question.robot, rows.configurations);
    } catch (const InvalidInput& error) {
        throw InvalidInput(io::one_line(question.path) + ": " + error.what());
    }
}

} // namespace chasles::cli
