#include "cli/robot_question.h"

#include "chasles/io/text_scan.h"
#include "cli/joint_trajectory.h"
#include "cli/report.h"

#include <array>
#include <map>
#include <variant>

namespace chasles::cli {
namespace {

[[noreturn]] void refuse_no_path(const Robot& robot, const std::string& name) {
    std::string names;
    for (const RobotVariable& variable : robot.variables())
        names += (names.empty() ? "" : ", ") + variable.name;
    throw InvalidInput("--path: is needed for the " + counted(robot.variables().size(), "variable") + " of the robot" +
                       (name.empty() ? "" : " " + name) + ": " + names);
}

/// The path of a robot from a file, and what the file says that has no effect.
class PathReader {
public:
    explicit PathReader(std::vector<std::string>& warnings) : warnings_(warnings) {}

    /// A robot without variables stays as it is if there is no file.
    JointPath read(const Robot& robot, const std::string* file) {
        if (!file && !robot.variables().empty())
            refuse_no_path(robot, "");
        if (!file)
            return JointPath::straight(robot, std::array{robot.neutral(), robot.neutral()});
        const robot::ConfigurationRows rows = rows_of(robot, *file, 2, "");
        has_stamps_ = !rows.stamps.empty();
        return path_of(robot, rows, *file);
    }
    /// The path of one of several robots. A file with one row says where the robot rests.
    std::variant<JointPath, Configuration> read_member(const std::string& name, const Robot& robot,
                                                       const std::string& file) {
        const robot::ConfigurationRows rows = rows_of(robot, file, 1, name + ": ");
        if (rows.configurations.size() == 1)
            return rows.configurations.front();
        return path_of(robot, rows, file);
    }
    [[nodiscard]] bool has_stamps() const { return has_stamps_; }

private:
    robot::ConfigurationRows rows_of(const Robot& robot, const std::string& file, std::size_t least,
                                     const std::string& place) {
        robot::ConfigurationRows rows = load_joint_path(file, robot, least);
        warnings_.insert(warnings_.end(), rows.warnings.begin(), rows.warnings.end());
        for (const std::string& warning : robot.warnings_about(rows.configurations))
            warnings_.push_back("path: " + place + warning);
        return rows;
    }
    static JointPath path_of(const Robot& robot, const robot::ConfigurationRows& rows, const std::string& file) {
        return at_place(io::one_line(file), [&] {
            return rows.stamps.empty() ? JointPath::straight(robot, rows.configurations)
                                       : JointPath::straight(robot, rows.configurations, rows.stamps);
        });
    }

    std::vector<std::string>& warnings_;
    bool has_stamps_ = false;
};

JointPath read_together(const NamedRobots& robots, const Robot& cell, const std::vector<std::string>& given,
                        PathReader& reader) {
    std::vector<std::string> names;
    for (const auto& [name, robot] : robots)
        names.push_back(name);
    const std::map<std::string, std::string> files = values_by_robot("--path", given, names);
    JointPath::OfRobots paths;
    bool has_path = false;
    for (const auto& [name, robot] : robots)
        if (const auto file = files.find(name); file != files.end()) {
            const auto read = paths.emplace(name, reader.read_member(name, robot, file->second)).first;
            has_path = has_path || std::holds_alternative<JointPath>(read->second);
        } else if (!robot.variables().empty()) {
            refuse_no_path(robot, name);
        }
    if (cell.variables().empty())
        return JointPath::straight(cell, std::array{cell.neutral(), cell.neutral()});
    if (!has_path)
        throw InvalidInput("--path: every robot of the cell rests; repeat the row of one of them to ask about the cell "
                           "at rest");
    return JointPath::together(cell, paths);
}

Handover handover_of(const std::string& given) {
    std::vector<std::string> fields(1);
    for (const char c : given)
        if (c == ',')
            fields.emplace_back();
        else
            fields.back() += c;
    if (fields.size() < 3)
        throw InvalidInput("--handover: " + io::in_quotes(given) + " is not of the form TIME,PART,LINK");
    return {number_of("--handover", fields[0]), fields[1], fields[2], {fields.begin() + 3, fields.end()}};
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

namespace {

void change_robot(Robot& robot, const RobotCommand& options, const std::optional<SceneFile>& scene,
                  std::vector<std::string>& warnings) {
    warnings = robot.warnings();
    const PolyhedronOptions attached{
        .triangulate = true, .solid = options.robot.solid, .radius = options.robot.radii.first};
    change(robot, scene ? &scene->scene : nullptr, options.changes, attached, warnings);
}

} // namespace

Robot read_robot(const RobotCommand& options, const std::optional<SceneFile>& scene,
                 std::vector<std::string>& warnings) {
    Robot robot = together(load_robots(options.robot));
    change_robot(robot, options, scene, warnings);
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
    const NamedRobots robots = load_robots(options.robot);
    Robot robot = together(robots);
    change_robot(robot, options, scene, warnings);
    std::vector<std::string> of_path;
    PathReader reader(of_path);
    const auto read = [&] {
        if (is_cell(robots))
            return read_together(robots, robot, options.paths, reader);
        const auto file = values_by_robot("--path", options.paths, {""});
        return reader.read(robot, file.empty() ? nullptr : &file.begin()->second);
    };
    JointPath path = read();
    if (scene) {
        warnings.insert(warnings.end(), scene->warnings.begin(), scene->warnings.end());
        warn_of_margins(options, *scene, warnings);
    }
    warnings.insert(warnings.end(), of_path.begin(), of_path.end());
    std::vector<Handover> handovers;
    for (const std::string& given : options.handovers)
        handovers.push_back(handover_of(given));
    const bool has_stamps = is_cell(robots) || reader.has_stamps();
    return {std::move(robot), std::move(path), has_stamps,         std::move(handovers),
            std::move(scene), query,           std::move(warnings)};
}

} // namespace chasles::cli
