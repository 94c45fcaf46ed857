#include "cli/robot_changes.h"

#include "chasles/io/pose_text.h"
#include "chasles/io/text_scan.h"
#include "cli/mesh_units.h"
#include "cli/options.h"

#include <algorithm>
#include <filesystem>
#include <optional>

namespace chasles::cli {
namespace {

bool has_link(const Robot& robot, const std::string& name) {
    const auto& links = robot.description().links;
    return std::ranges::find(links, name, &LinkDescription::name) != links.end() ||
           std::ranges::find(robot.attached(), name, &AttachedPart::name) != robot.attached().end();
}

bool has_body(const Scene* scene, const std::string& name) {
    return scene && std::ranges::find(scene->bodies(), name, &SceneBody::name) != scene->bodies().end();
}

[[noreturn]] void refuse_pair(const std::string& given, const std::string& why) {
    throw InvalidInput("--allow: " + io::in_quotes(given) + why);
}

struct AllowedPair {
    std::string link;
    std::string other;
};

/// The name of a link or of a body may have a comma: one way to divide the text has to fit.
AllowedPair allowed_pair(const Robot& robot, const Scene* scene, const std::string& given) {
    std::optional<AllowedPair> found;
    for (std::size_t comma = given.find(','); comma != std::string::npos; comma = given.find(',', comma + 1)) {
        AllowedPair pair{given.substr(0, comma), given.substr(comma + 1)};
        if (!has_link(robot, pair.link) && has_body(scene, pair.link))
            std::swap(pair.link, pair.other);
        if (!has_link(robot, pair.link) || (!has_link(robot, pair.other) && !has_body(scene, pair.other)))
            continue;
        if (found)
            refuse_pair(given, " may mean " + io::in_quotes(found->link) + " and " + io::in_quotes(pair.link));
        found = std::move(pair);
    }
    if (found)
        return *found;
    const std::size_t comma = given.find(',');
    if (comma == std::string::npos)
        refuse_pair(given, " is not of the form LINK,BODY");
    const std::string link = given.substr(0, comma), other = given.substr(comma + 1);
    if (!has_link(robot, link))
        refuse_pair(given, ": the robot has no link or part " + io::in_quotes(link));
    refuse_pair(given, ": " + io::in_quotes(other) + " is no link, no part" +
                           (scene ? " and no body of the scene" : "; a body needs --scene"));
}

void allow(Robot& robot, const Scene* scene, const std::string& given) {
    const AllowedPair pair = allowed_pair(robot, scene, given);
    const bool is_link = has_link(robot, pair.other), is_body = has_body(scene, pair.other);
    if (is_link && is_body)
        refuse_pair(given, ": " + io::in_quotes(pair.other) + " is a link and a body of the scene; rename the body");
    if (is_body)
        robot.ignore_in_scene(pair.link, pair.other);
    else
        at_place("--allow", [&] { robot.ignore(pair.link, pair.other); });
}

/// The name of the file without its ending, with a number if that is taken, and a warning.
std::string part_name(const Robot& robot, const Scene* scene, const std::filesystem::path& mesh,
                      std::vector<std::string>& warnings) {
    const std::string stem = mesh.stem().string();
    std::string name = stem;
    for (int number = 2; has_link(robot, name) || has_body(scene, name); ++number)
        name = stem + '_' + std::to_string(number);
    if (name != stem)
        warnings.push_back("--attach: the name " + io::in_quotes(stem) + " is taken: the part has the name " +
                           io::in_quotes(name));
    return name;
}

void attach(Robot& robot, const Scene* scene, const std::string& given, const PolyhedronOptions& polyhedron,
            std::vector<std::string>& warnings) {
    const std::size_t first = given.find(','), second = given.find(',', first + 1);
    if (first == std::string::npos || second == std::string::npos)
        throw InvalidInput("--attach: " + io::in_quotes(given) + " is not of the form LINK,MESH,POSE");
    const std::string link = given.substr(0, first), mesh = given.substr(first + 1, second - first - 1);
    at_place("--attach", [&] {
        const Pose pose = at_place(io::in_quotes(given), [&] { return io::parse_pose(given.substr(second + 1)); });
        robot.attach(
            {part_name(robot, scene, mesh, warnings), link, load_with_unit(mesh, polyhedron, warnings).body, pose});
    });
}

} // namespace

void add_robot_change_options(CLI::App& command, RobotChangeOptions& options) {
    command
        .add_option("--allow", options.allow,
                    "a link or part, and a body of the scene or another link, that may touch: they are not tested; one "
                    "pair for each --allow")
        ->type_name("LINK,BODY")
        ->allow_extra_args(false);
    command
        .add_option("--attach", options.attach,
                    "a mesh that moves with a link, at a pose in its frame; its name is that of the file; one for each "
                    "--attach")
        ->type_name("LINK,MESH,POSE")
        ->allow_extra_args(false);
}

void change(Robot& robot, const Scene* scene, const RobotChangeOptions& options, const PolyhedronOptions& polyhedron,
            std::vector<std::string>& warnings) {
    for (const std::string& given : options.attach)
        attach(robot, scene, given, polyhedron, warnings);
    for (const std::string& given : options.allow)
        allow(robot, scene, given);
}

} // namespace chasles::cli
