#include "cli/robot_options.h"

#include "chasles/io/column_table.h"
#include "chasles/io/pose_text.h"
#include "chasles/io/text_scan.h"
#include "cli/options.h"

#include <algorithm>
#include <filesystem>

namespace chasles::cli {

namespace {

void add_packages_option(CLI::App& command, RobotOptions& options) {
    command
        .add_option(
            "--packages", options.packages,
            "folder of a package of package:// paths; one for each --packages, which may be given several times")
        ->type_name("NAME=FOLDER")
        ->allow_extra_args(false);
}

/// Both sides of the first sign of equality. Throws InvalidInput where one is empty.
std::pair<std::string, std::string> name_and_value(const char* option, const std::string& given, const char* form) {
    const std::size_t sign = given.find('=');
    if (sign == 0 || sign == std::string::npos || sign + 1 == given.size())
        throw InvalidInput(std::string(option) + ": " + io::in_quotes(given) + " is not of the form " + form);
    return {given.substr(0, sign), given.substr(sign + 1)};
}

Robot load_file(const RobotOptions& options, const std::string& urdf, const std::string& srdf) {
    RobotFiles files{.srdf = srdf, .solid = options.solid, .radius = options.radii.first};
    for (const std::string& given : options.packages) {
        const auto [name, folder] = name_and_value("--packages", given, "NAME=FOLDER");
        files.packages[name] = folder;
    }
    return Robot::load(urdf, files);
}

} // namespace

void add_robot_file_options(CLI::App& command, RobotOptions& options) {
    command.add_option("--srdf", options.srdf, "SRDF file: which links are not tested against each other")
        ->type_name("FILE");
    add_packages_option(command, options);
}

void add_cell_options(CLI::App& command, RobotOptions& options) {
    command
        .add_option("ROBOT", options.robots,
                    "URDF file; or several robots in one cell, NAME=FILE each: then all values that belong to one "
                    "robot have NAME=VALUE, once for each robot")
        ->required()
        ->type_name("[NAME=]FILE");
    command.add_option("--srdf", options.srdfs, "SRDF file: which links are not tested against each other")
        ->type_name("[NAME=]FILE")
        ->allow_extra_args(false);
    command.add_option("--base", options.bases, "pose of the root link of a robot in the world")
        ->type_name("[NAME=]POSE")
        ->allow_extra_args(false);
    add_packages_option(command, options);
    add_solid_option(command, options.solid);
}

Robot load_robot(const RobotOptions& options) {
    return load_file(options, options.urdf, options.srdf);
}

std::map<std::string, std::string> values_by_robot(const char* option, const std::vector<std::string>& given,
                                                   const std::vector<std::string>& names) {
    std::map<std::string, std::string> values;
    for (const std::string& text : given) {
        const auto [name, value] = names == std::vector<std::string>{""} ? std::pair(names.front(), text)
                                                                         : name_and_value(option, text, "NAME=VALUE");
        if (std::ranges::find(names, name) == names.end())
            throw InvalidInput(std::string(option) + ": there is no robot " + io::in_quotes(name) + ", only " +
                               io::shown_names(names));
        if (!values.emplace(name, value).second)
            throw InvalidInput(std::string(option) + ": is given twice" + (name.empty() ? "" : " for " + name));
    }
    return values;
}

namespace {

/// A single file has the name "", unless a robot is named before it. A name has no slash, but a folder may have the
/// sign.
std::pair<std::string, std::string> named_file(const RobotOptions& options, const std::string& given) {
    const std::size_t sign = given.find('=');
    std::error_code ignored;
    if (options.robots.size() == 1 &&
        (sign == std::string::npos || given.find('/') < sign || std::filesystem::exists(given, ignored)))
        return {"", given};
    return name_and_value("ROBOT", given, "NAME=FILE, which each of several robots needs");
}

} // namespace

NamedRobots load_robots(const RobotOptions& options) {
    std::vector<std::pair<std::string, std::string>> files;
    for (const std::string& given : options.robots)
        files.push_back(named_file(options, given));
    std::vector<std::string> names;
    for (const auto& [name, file] : files)
        names.push_back(name);
    const auto srdfs = values_by_robot("--srdf", options.srdfs, names);
    const auto bases = values_by_robot("--base", options.bases, names);
    NamedRobots robots;
    for (const auto& [name, file] : files) {
        const auto srdf = srdfs.find(name), base = bases.find(name);
        robots.emplace_back(name, load_file(options, file, srdf == srdfs.end() ? "" : srdf->second));
        if (base != bases.end())
            robots.back().second.set_base(at_place("--base", [&] { return io::parse_pose(base->second); }));
    }
    return robots;
}

bool is_cell(const NamedRobots& robots) {
    return !robots.front().first.empty();
}

Robot together(const NamedRobots& robots) {
    return !is_cell(robots) ? robots.front().second : Robot::together(robots);
}

} // namespace chasles::cli
