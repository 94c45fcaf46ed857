#include "cli/robot_info.h"

#include "chasles/io/text_scan.h"
#include "cli/commands.h"
#include "cli/output.h"
#include "cli/report.h"
#include "cli/untested_text.h"
#include "cli/warnings.h"
#include "view/answer_json.h"
#include "view/names.h"

#include <cmath>
#include <filesystem>
#include <fmt/format.h>

namespace chasles::cli {
namespace {

/// The variables of a joint; one that is fixed or follows another joint has none.
std::vector<RobotVariable> variables_of(const Robot& robot, const JointDescription& joint) {
    std::vector<RobotVariable> variables;
    for (const RobotVariable& variable : robot.variables())
        if (variable.name == joint.name || variable.name.starts_with(joint.name + '/'))
            variables.push_back(variable);
    return variables;
}

std::size_t faces_of(const LinkDescription& link) {
    std::size_t faces = 0;
    for (const CollisionDescription& shape : link.collisions)
        faces += shape.shape.face_count();
    return faces;
}

view::Json joint_json(const Robot& robot, const JointDescription& joint) {
    view::Json json{{"name", joint.name},
                    {"type", view::name_of(joint.type)},
                    {"parent", joint.parent},
                    {"child", joint.child},
                    {"variables", view::Json::array()}};
    for (const RobotVariable& variable : variables_of(robot, joint))
        json["variables"].push_back({{"name", variable.name},
                                     {"lower", variable.lower},
                                     {"upper", variable.upper},
                                     {"continuous", variable.is_continuous}});
    if (joint.mimic)
        json["mimic"] = {
            {"joint", joint.mimic->joint}, {"multiplier", joint.mimic->multiplier}, {"offset", joint.mimic->offset}};
    return json;
}

view::Json robot_json(const Robot& robot) {
    view::Json json{
        {"name", robot.description().name}, {"joints", view::Json::array()}, {"links", view::Json::array()}};
    for (const JointDescription& joint : robot.description().joints)
        json["joints"].push_back(joint_json(robot, joint));
    for (const LinkDescription& link : robot.description().links)
        json["links"].push_back({{"name", link.name}, {"shapes", link.collisions.size()}, {"faces", faces_of(link)}});
    for (const GroupDescription& group : robot.description().groups)
        json["groups"].push_back({{"name", group.name}, {"joints", group.joints}, {"links", group.links}});
    for (const StateDescription& state : robot.description().states)
        json["states"].push_back({{"name", state.name}, {"group", state.group}});
    json["tested"] = robot.tested_pairs();
    json["untested"] = view::untested_json(RobotChecker(robot).untested());
    json["warnings"] = robot.warnings();
    return json;
}

std::string limits_text(const RobotVariable& variable) {
    if (variable.is_continuous)
        return "continuous";
    return std::isinf(variable.lower) && std::isinf(variable.upper)
               ? "without limits"
               : fmt::format("{:.9g} to {:.9g}", variable.lower, variable.upper);
}

std::string joint_lines(const Robot& robot, const JointDescription& joint) {
    const std::string text =
        fmt::format("{}: {}, {} to {}", joint.name, view::name_of(joint.type), joint.parent, joint.child);
    if (joint.mimic)
        return labelled("joint", fmt::format("{}, follows {}: {:.9g} times its value, plus {:.9g}", text,
                                             joint.mimic->joint, joint.mimic->multiplier, joint.mimic->offset));
    const std::vector<RobotVariable> variables = variables_of(robot, joint);
    if (variables.size() == 1)
        return labelled("joint", text + ", " + limits_text(variables.front()));
    std::string lines = labelled("joint", text);
    for (const RobotVariable& variable : variables)
        lines += labelled("", "  " + variable.name + ", " + limits_text(variable));
    return lines;
}

std::string robot_text(const std::string& file, const Robot& robot) {
    const RobotDescription& description = robot.description();
    std::string text =
        fmt::format("{}: robot {}, {}, {}\n", file, description.name, counted(description.links.size(), "link"),
                    counted(robot.variables().size(), "variable"));
    for (const JointDescription& joint : description.joints)
        text += joint_lines(robot, joint);
    for (const LinkDescription& link : description.links)
        text += labelled("link", link.collisions.empty()
                                     ? link.name + ": no shapes"
                                     : fmt::format("{}: {}, {}", link.name, counted(link.collisions.size(), "shape"),
                                                   counted(faces_of(link), "face")));
    for (const StateDescription& state : description.states)
        text += labelled("state", state.name + (state.group.empty() ? "" : " of " + state.group));
    std::string pairs;
    for (const auto& [first, second] : robot.tested_pairs())
        pairs += (pairs.empty() ? ": " : ", ") + first + " and " + second;
    const UntestedPairs untested = RobotChecker(robot).untested();
    return text + labelled("tested", counted(untested.tested, "pair") + pairs) + report(untested);
}

} // namespace

bool is_robot_file(const std::string& file) {
    return io::lower_case(std::filesystem::path(file).extension().string()) == ".urdf";
}

int run_robot_info(const RobotOptions& options, bool json) {
    const Robot robot = load_robot(options);
    print(json ? robot_json(robot).dump() + "\n" : robot_text(options.urdf, robot));
    print_warnings(robot.warnings());
    return is_clear;
}

} // namespace chasles::cli
