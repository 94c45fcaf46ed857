// One path of several robots: cut at all their stamps, so that each segment has polynomials.
// Source: docs/derivations/42-several-robots.md, "Clocks".
#include "chasles/base/invalid_input.h"
#include "chasles/robot/model.h"
#include "chasles/robot/path_parts.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace chasles {

namespace {

using Segment = JointPath::Segment;

[[noreturn]] void refuse_path(const std::string& robot, const std::string& why) {
    throw InvalidInput("path: " + (robot.empty() ? "" : robot + ": ") + why);
}

/// A robot of a cell.
struct Member {
    std::vector<std::size_t> columns; ///< its variables
    const JointPath* path = nullptr;  ///< null: it rests
};
using Members = std::map<std::string, Member, std::less<>>;

/// By the names in front of those of links and variables.
Members members_of(const robot::Model& model) {
    Members members;
    for (const LinkDescription& link : model.description.links)
        if (const std::size_t slash = link.name.find('/'); slash != std::string::npos)
            members[link.name.substr(0, slash)];
    for (std::size_t i = 0; i < model.variables.size(); ++i) {
        const std::string& name = model.variables[i].name;
        const auto member = members.find(name.substr(0, name.find('/')));
        if (member == members.end())
            refuse_path("",
                        "the variable " + name + " is that of no robot of a cell; a cell is made by Robot::together");
        member->second.columns.push_back(i);
    }
    return members;
}

std::string names_of_members(const Members& members) {
    std::string names;
    for (const auto& [name, member] : members)
        names += (names.empty() ? "" : ", ") + name;
    return names;
}

std::string other_count(std::size_t given, const char* what, const Member& member) {
    return "has " + std::to_string(given) + ' ' + what + ", and the robot has " +
           std::to_string(member.columns.size()) + " variables";
}

/// Refuses a path of a robot with other variables.
void check_path(const robot::Model& model, const std::string& name, const Member& member, const JointPath& path) {
    const auto count = std::size_t(path.segments().front().coefficients.cols());
    if (count != member.columns.size())
        refuse_path(name, other_count(count, "variables", member));
    for (std::size_t i = 0; path.variables() && i < count; ++i) {
        const RobotVariable &own = model.variables[member.columns[i]], &given = path.variables()->at(i);
        if (own.name != name + '/' + given.name || own.is_continuous != given.is_continuous)
            refuse_path(name, "belongs to another robot: its variable " + std::to_string(i) + " is " + given.name +
                                  (given.is_continuous ? ", which is continuous" : "") + ", and that of the robot is " +
                                  own.name.substr(name.size() + 1) +
                                  (own.is_continuous ? ", which is continuous" : ""));
    }
}

/// Where all robots rest that have no path.
Configuration rest_of(const Robot& cell, Members& members, const JointPath::OfRobots& paths) {
    Configuration rest = cell.neutral();
    for (const auto& [name, given] : paths) {
        const auto found = members.find(name);
        if (found == members.end())
            refuse_path(name, "there is no such robot in the cell, which has " + names_of_members(members));
        Member& member = found->second;
        if (const auto* const path = std::get_if<JointPath>(&given)) {
            check_path(cell.model(), name, member, *path);
            member.path = path;
            continue;
        }
        const auto& values = std::get<Configuration>(given);
        if (std::size_t(values.size()) != member.columns.size())
            refuse_path(name, other_count(std::size_t(values.size()), "values", member));
        for (std::size_t i = 0; i < member.columns.size(); ++i)
            rest[Eigen::Index(member.columns[i])] = values[Eigen::Index(i)];
    }
    for (const auto& [name, member] : members)
        if (!member.columns.empty() && !paths.contains(name))
            refuse_path(name, "has no path; give one, or the configuration at which it rests");
    return rest;
}

/// All stamps at which a robot begins or ends a segment, in order.
std::vector<double> stamps_of(const Members& members) {
    std::vector<double> stamps;
    for (const auto& [name, member] : members)
        if (member.path)
            for (const Segment& segment : member.path->segments())
                stamps.insert(stamps.end(), {segment.begin, segment.end});
    if (stamps.empty())
        refuse_path("", "no robot of the cell has a path: for a cell at rest, make a straight path of its "
                        "configuration twice");
    std::ranges::sort(stamps);
    const auto repeated = std::ranges::unique(stamps);
    stamps.erase(repeated.begin(), repeated.end());
    if (!std::isfinite(stamps.back() - stamps.front()))
        refuse_path("", "the stamps of the robots are too far from each other");
    return stamps;
}

/// The part of a path between two stamps of which no other stamp is between.
Segment part_between(const JointPath& path, double lower, double upper) {
    const std::vector<Segment>& segments = path.segments();
    const auto after = std::ranges::upper_bound(segments, lower, {}, &Segment::begin); // the first that begins later
    if (after == segments.begin())
        return robot::rest_at_begin(*after);
    const Segment& segment = *(after - 1);
    return segment.end <= lower ? robot::rest_at_end(segment)
                                : robot::part_of(segment, lower, upper, path.quaternions());
}

void set_columns(Segment& segment, const Member& member, const Segment& part) {
    const Eigen::Index rows = part.coefficients.rows(), before = segment.coefficients.rows();
    if (rows > before)
        for (Eigen::MatrixXd* const matrix : {&segment.coefficients, &segment.remainders}) {
            matrix->conservativeResize(rows, Eigen::NoChange);
            matrix->bottomRows(rows - before).setZero();
        }
    for (std::size_t i = 0; i < member.columns.size(); ++i) {
        const auto column = Eigen::Index(member.columns[i]), own = Eigen::Index(i);
        segment.coefficients.col(column).setZero();
        segment.coefficients.col(column).head(rows) = part.coefficients.col(own);
        if (part.remainders.size() > 0)
            segment.remainders.col(column).head(rows) = part.remainders.col(own);
    }
}

} // namespace

JointPath JointPath::together(const Robot& cell, const OfRobots& paths) {
    const robot::Model& model = cell.model();
    Members members = members_of(model);
    const Configuration rest = rest_of(cell, members, paths);
    const Segment at_rest = robot::rest_at_begin(straight(cell, std::array{rest, rest}).segments().front());
    const std::vector<double> stamps = stamps_of(members);
    std::vector<Segment> segments;
    for (std::size_t s = 0; s + 1 < stamps.size(); ++s) {
        Segment segment{stamps[s], stamps[s + 1], at_rest.coefficients, at_rest.remainders};
        for (const auto& [name, member] : members)
            if (member.path)
                set_columns(segment, member, part_between(*member.path, stamps[s], stamps[s + 1]));
        segments.push_back(std::move(segment));
    }
    return {std::move(segments), model.quaternions, model.variables_of_paths, Knots::none};
}

} // namespace chasles
