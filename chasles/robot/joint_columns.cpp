// Names of columns are those of the robot's variables. Source: docs/decisions/0090-columns-by-name.md.
#include "chasles/robot/joint_columns.h"

#include "chasles/base/invalid_input.h"
#include "chasles/base/number_text.h"
#include "chasles/io/column_table.h"
#include "chasles/robot/model.h"

#include <algorithm>
#include <array>
#include <numbers>

namespace chasles::robot {
namespace {

constexpr std::string_view degrees_ending = "_deg";
constexpr auto names_of_degrees = std::to_array<std::string_view>({"deg", "degree", "degrees"});
constexpr auto names_of_radians = std::to_array<std::string_view>({"rad", "radian", "radians"});
/// What writers of files put after the name of a joint whose position they mean.
constexpr auto other_endings =
    std::to_array<std::string_view>({"", "m", "mm", "cm", "meter", "meters", "metre", "metres", "pos", "position",
                                     "positions", "value", "values", "joint"});
/// Words for other quantities of a joint, such as in "effort_waist".
constexpr auto other_quantities =
    std::to_array<std::string_view>({"vel", "velocity", "speed", "acc", "acceleration", "effort", "torque", "force",
                                     "current", "voltage", "temperature", "error"});

template <typename Names>
bool is_among(const Names& names, std::string_view name) {
    return std::ranges::find(names, name) != names.end();
}

// The variable of this name. Throws InvalidInput where capitals would decide between two.
std::optional<std::size_t> variable_named(const Robot& robot, std::string_view name) {
    const auto variables = robot.variables();
    const auto exact = std::ranges::find(variables, name, &RobotVariable::name);
    if (exact != variables.end())
        return static_cast<std::size_t>(exact - variables.begin());
    std::optional<std::size_t> found;
    for (std::size_t i = 0; i < variables.size(); ++i) {
        if (io::lower_case(variables[i].name) != io::lower_case(name))
            continue;
        if (found)
            throw InvalidInput("the column " + io::in_quotes(name) + " may be the variable " +
                               io::in_quotes(variables[*found].name) + " or " + io::in_quotes(variables[i].name));
        found = i;
    }
    return found;
}

/// Whether the variable is an angle.
bool is_angle(const Robot& robot, const std::string& variable) {
    return std::ranges::any_of(robot.description().joints, [&](const JointDescription& joint) {
        return joint.type == JointType::planar
                   ? variable == joint.name + "/theta"
                   : (joint.type == JointType::revolute || joint.type == JointType::continuous) &&
                         variable == joint.name;
    });
}

/// Whether the variable is a length.
bool is_length(const Robot& robot, const std::string& variable) {
    return std::ranges::any_of(robot.description().joints, [&](const JointDescription& joint) {
        return (joint.type == JointType::prismatic && variable == joint.name) ||
               (joint.type == JointType::planar && variable.starts_with(joint.name + '/') &&
                !is_angle(robot, variable)) ||
               (joint.type == JointType::floating && variable.starts_with(joint.name + "/trans_"));
    });
}

/// The variable whose position a name of PlotJuggler means: "a1.position", "/joint_states/a1/position".
std::optional<std::size_t> variable_with_position(const Robot& robot, std::string_view name) {
    constexpr std::string_view position = "position", separators = "./";
    if (!io::lower_case(name).ends_with(position) || name.size() < position.size() + 2 ||
        separators.find(name[name.size() - position.size() - 1]) == std::string_view::npos)
        return std::nullopt;
    const std::string_view base = name.substr(0, name.size() - position.size() - 1);
    std::size_t longest = 0; // a variable may have a separator in its name
    for (const RobotVariable& variable : robot.variables()) {
        const std::size_t size = variable.name.size();
        if (size > longest && size <= base.size() &&
            (size == base.size() || separators.find(base[base.size() - size - 1]) != std::string_view::npos) &&
            io::lower_case(base.substr(base.size() - size)) == io::lower_case(variable.name))
            longest = size;
    }
    return longest == 0 ? std::nullopt : variable_named(robot, base.substr(base.size() - longest));
}

std::string_view without_degrees(std::string_view name) {
    const bool has_ending = io::lower_case(name).ends_with(degrees_ending);
    return has_ending ? name.substr(0, name.size() - degrees_ending.size()) : std::string_view();
}

/// Whether a name is that of the variable and an ending which says that its value is meant: "spin_rad", "Spin.pos",
/// "spin[a][b]".
bool is_with_ending(const std::string& name, const std::string& variable) {
    if (!name.starts_with(variable) || name.size() == variable.size())
        return false;
    const std::string_view rest = std::string_view(name).substr(variable.size());
    const std::size_t begin = std::min(rest.find_first_not_of(" _.-/:"), rest.size());
    const std::string_view ending = rest.substr(begin);
    if (ending.starts_with('[') || ending.starts_with('('))
        return true;
    return begin > 0 && (is_among(names_of_degrees, ending) || is_among(names_of_radians, ending) ||
                         is_among(other_endings, ending));
}

// Whether a name is that of the variable in a namespace or after another word: "arm1/waist", "robot_waist". A word for
// another quantity is none.
bool is_with_word(std::string_view name, std::string_view variable) {
    constexpr std::string_view separators = " _.-/:";
    if (!name.ends_with(variable) || name.size() <= variable.size() + 1)
        return false;
    const std::string_view before = name.substr(0, name.size() - variable.size() - 1);
    const std::string_view word = before.substr(before.find_last_of(separators) + 1);
    return separators.find(name[before.size()]) != std::string_view::npos && !is_among(other_quantities, word);
}

/// Why the name of a joint is not that of a variable.
std::string why_no_variable(const JointDescription& joint) {
    if (joint.mimic)
        return "which follows " + io::in_quotes(joint.mimic->joint);
    return joint.type == JointType::fixed ? "which is fixed" : "which has several variables";
}

bool may_be(const std::string& name, const std::string& variable) {
    return io::differ_by_a_slip(name, variable) || is_with_word(name, variable) || is_with_ending(name, variable);
}

} // namespace

std::string names_of_variables(const Robot& robot) {
    std::vector<std::string> names;
    for (const RobotVariable& variable : robot.variables())
        names.push_back(variable.name);
    return io::shown_names(names);
}

JointColumns::JointColumns(std::span<const std::string> names, const Robot& robot, JointUnits units)
    : robot_(robot), names_(names.begin(), names.end()) {
    io::require_different(names);
    for (const std::string& name : names) {
        columns_.push_back(column_of(name, units));
        if (!columns_.back().variable)
            ignored_.push_back(name);
    }
    if (ignored_.size() == names.size() && !robot.variables().empty())
        throw InvalidInput("the header " +
                           (names.empty() ? "has no column of a joint, and so" : io::shown_names(names)) +
                           " names no variable of the robot, which has " + names_of_variables(robot) +
                           "; fixed joints and joints that follow others have none");
    require_one_each(names);
    require_no_misspelt_name();
}

/// The column of a name with a unit in brackets, where `column` is that of the name without it.
JointColumns::Column JointColumns::with_unit(const Column& column, std::string_view name, std::string_view unit) const {
    const std::string& variable = robot_.variables()[*column.variable].name;
    const bool turns = is_angle(robot_, variable);
    if (is_among(names_of_degrees, unit) && !turns)
        throw InvalidInput("the column " + io::in_quotes(name) + " has degrees, but the variable " +
                           io::in_quotes(variable) + " is no angle");
    if (turns && is_among(names_of_degrees, unit))
        return {column.variable, true};
    const bool is_unit = turns ? is_among(names_of_radians, unit) : is_length(robot_, variable) && unit == "m";
    if (unit.empty() || (is_unit && !column.is_in_degrees))
        return column;
    throw InvalidInput("the column " + io::in_quotes(name) + " has a unit that is not read; the variable " +
                       io::in_quotes(variable) + " may have " +
                       (turns                         ? "[rad] or [deg]"
                        : is_length(robot_, variable) ? "[m]"
                                                      : "[]") +
                       ", or no unit: convert the numbers");
}

JointColumns::Column JointColumns::column_of(std::string_view name, JointUnits units) const {
    const Column column = column_without_unit(name, units);
    const auto [base, unit] = io::split_unit(name);
    if (column.variable || !unit || base.empty() || units == JointUnits::radians)
        return column;
    const Column without = column_without_unit(base, units);
    return without.variable ? with_unit(without, name, *unit) : column;
}

/// The column of a name that may end in "_deg".
JointColumns::Column JointColumns::column_without_unit(std::string_view name, JointUnits units) const {
    const std::optional<std::size_t> plain = variable_named(robot_, name);
    const std::string_view before = without_degrees(name);
    if (units == JointUnits::radians)
        return {plain};
    if (before.empty())
        return {plain ? plain : variable_with_position(robot_, name)};
    const std::optional<std::size_t> turned = variable_named(robot_, before);
    if (plain && turned)
        throw InvalidInput("the column " + io::in_quotes(name) + " may be the variable " + io::in_quotes(name) +
                           ", or " + io::in_quotes(before) + " in degrees");
    if (turned && !is_angle(robot_, robot_.variables()[*turned].name))
        throw InvalidInput("the column " + io::in_quotes(name) + " has degrees, but the variable " +
                           io::in_quotes(before) + " is no angle");
    return plain ? Column{plain} : Column{turned, true};
}

void JointColumns::require_one_each(std::span<const std::string> names) const {
    std::vector<std::optional<std::size_t>> place_of(robot_.variables().size());
    for (std::size_t i = 0; i < names.size(); ++i) {
        if (!columns_[i].variable)
            continue;
        std::optional<std::size_t>& place = place_of[*columns_[i].variable];
        if (place)
            throw InvalidInput("the header " + io::shown_names(names) + " has two columns for one variable: " +
                               io::in_quotes(names[*place]) + " and " + io::in_quotes(names[i]));
        place = i;
    }
}

// A variable that is left out stays where it is. Nobody wants that of a variable whose name is misspelt.
void JointColumns::require_no_misspelt_name() const {
    for (const std::string& variable : missing())
        for (const std::string& name : ignored_)
            if (may_be(io::lower_case(name), io::lower_case(variable)))
                throw InvalidInput("the column " + io::in_quotes(name) +
                                   " is no variable of the robot; it may be a misspelt " + io::in_quotes(variable) +
                                   ", which has no column, or one to leave out of the file");
}

std::vector<std::string> JointColumns::missing() const {
    std::vector<std::string> missing;
    for (std::size_t i = 0; i < robot_.variables().size(); ++i)
        if (std::ranges::find(columns_, std::optional(i), &Column::variable) == columns_.end())
            missing.push_back(robot_.variables()[i].name);
    return missing;
}

std::vector<std::string> JointColumns::warnings(const std::string& plural) const {
    std::vector<std::string> lines, unknown;
    for (const std::string& name : ignored_) {
        const auto& joints = robot_.description().joints;
        const auto joint = std::ranges::find(joints, name, &JointDescription::name);
        if (joint == joints.end())
            unknown.push_back(name);
        else
            lines.push_back("ignored " + plural + ": " + io::in_quotes(name) + ", " + why_no_variable(*joint));
    }
    if (!unknown.empty())
        lines.push_back("ignored " + plural + ": " + io::shown_names(unknown) +
                        "; the robot has no variables of these names");
    if (const std::vector<std::string> variables = missing(); !variables.empty())
        lines.push_back("no values for " + io::shown_names(variables) + ": they stay at their neutral values");
    return lines;
}

Configuration JointColumns::configuration(std::span<const double> row) const {
    Configuration values = robot_.neutral();
    for (std::size_t i = 0; i < row.size(); ++i) {
        const auto& [variable, is_in_degrees] = columns_[i];
        if (!variable)
            continue;
        const double value = is_in_degrees ? row[i] / 180 * std::numbers::pi : row[i];
        if (const std::string why = why_too_large(robot_.model(), *variable, value); !why.empty())
            throw InvalidInput(io::one_line(names_[i]) + ": " + number_text(row[i], 9) + why);
        values[static_cast<Eigen::Index>(*variable)] = value;
    }
    return values;
}

bool JointColumns::is_name(const Robot& robot, std::string_view name) {
    const auto is_variable = [&](std::string_view text) {
        return std::ranges::any_of(robot.variables(), [&](const RobotVariable& variable) {
            return io::lower_case(variable.name) == io::lower_case(text);
        });
    };
    const std::string_view base = io::split_unit(name).name;
    return is_variable(name) || is_variable(base) || is_variable(without_degrees(base)) ||
           variable_with_position(robot, base).has_value();
}

} // namespace chasles::robot
