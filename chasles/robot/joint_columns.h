// The columns of a path of a robot: which variable each name stands for.
#pragma once

#include "chasles/robot/robot.h"

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace chasles::robot {

/// What the numbers of a path are.
enum class JointUnits {
    /// Columns NAME_deg and NAME[deg] have degrees, every other one radians or the length unit. NAME may end in
    /// ".position" or "/position", and begin with other words before such a point or slash.
    by_name,
    radians, ///< no name means degrees
};

/// The names of all variables, for messages.
std::string names_of_variables(const Robot& robot);

/// Maps rows of numbers to configurations.
class JointColumns {
public:
    /// `names` are those of variables of the robot, in any order. Capitals count as small letters where only one
    /// variable has the name. Throws InvalidInput if no column is a variable, if two columns are one variable, if a
    /// column may be two variables, if the unit of a column is not read, and if the name of a column differs in one
    /// letter or by a unit from a variable without a column.
    JointColumns(std::span<const std::string> names, const Robot& robot, JointUnits units);

    /// Variables that are left out have the values of Robot::neutral(). The row has a number for each name; numbers of
    /// columns that are not read are not used. Throws InvalidInput for a value that no path may have.
    [[nodiscard]] Configuration configuration(std::span<const double> row) const;
    [[nodiscard]] bool reads(std::size_t column) const { return columns_[column].variable.has_value(); }
    /// One line each about names that are not read, and about variables that have no name. `plural` says what the
    /// names are those of: "columns".
    [[nodiscard]] std::vector<std::string> warnings(const std::string& plural) const;

    /// Whether a name may be that of a column.
    static bool is_name(const Robot& robot, std::string_view name);

private:
    struct Column {
        std::optional<std::size_t> variable;
        bool is_in_degrees = false;
    };

    [[nodiscard]] Column column_of(std::string_view name, JointUnits units) const;
    [[nodiscard]] Column column_without_unit(std::string_view name, JointUnits units) const;
    [[nodiscard]] Column with_unit(const Column& column, std::string_view name, std::string_view unit) const;
    void require_one_each(std::span<const std::string> names) const;
    void require_no_misspelt_name() const;
    /// The variables without a column.
    [[nodiscard]] std::vector<std::string> missing() const;

    const Robot& robot_;
    std::vector<std::string> names_;
    std::vector<Column> columns_;
    std::vector<std::string> ignored_;
};

} // namespace chasles::robot
