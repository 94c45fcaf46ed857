// Reads paths of robots from tables with named columns.
#include "chasles/robot/joint_path_file.h"

#include "chasles/base/invalid_input.h"
#include "chasles/io/column_table.h"
#include "chasles/io/pose_columns.h"
#include "chasles/robot/joint_columns.h"

#include <optional>

namespace chasles::robot {
namespace {

// A variable of the robot may be called "t".
bool is_stamp_of(const Robot& robot, std::string_view name) {
    return io::is_time_column(name) && !JointColumns::is_name(robot, name);
}

/// The columns of a table: the stamp, and the names of all others.
struct JointTable {
    std::optional<std::size_t> stamp;
    std::vector<std::string> names; ///< without the stamp

    JointTable(const std::vector<std::string>& all, const Robot& robot) {
        for (std::size_t i = 0; i < all.size(); ++i) {
            if (!is_stamp_of(robot, all[i])) {
                names.push_back(all[i]);
                continue;
            }
            if (stamp)
                throw InvalidInput("the header " + io::shown_names(all) + " has two columns for the time: " +
                                   io::in_quotes(all[*stamp]) + " and " + io::in_quotes(all[i]));
            stamp = i;
        }
    }
};

void read_configuration(const io::TableRow& row, const std::vector<std::string>& names, const JointTable& table,
                        const JointColumns& columns, ConfigurationRows& rows) {
    io::require_cells(row, names.size());
    std::vector<double> numbers;
    for (std::size_t i = 0; i < names.size(); ++i)
        if (i == table.stamp)
            io::add_stamp(io::cell_number(row.cells[i], names[i]), names[i], rows.stamps);
        else
            numbers.push_back(columns.reads(numbers.size()) ? io::cell_number(row.cells[i], names[i]) : 0);
    rows.configurations.push_back(columns.configuration(numbers));
}

// What `read` returns. What it throws gets the number of a line in front.
template <typename Read>
auto at_line(std::size_t line, const Read& read) {
    try {
        return read();
    } catch (const InvalidInput& error) {
        io::fail_at_line(line, error.what());
    }
}

[[noreturn]] void refuse_no_names(const io::ColumnTable& text, const Robot& robot) {
    const std::string needed = "the first line has to name variables of the robot, of " + names_of_variables(robot);
    if (text.columns() == 0)
        throw InvalidInput("has no header; " + needed);
    io::fail_at_line(text.line(), "there is no header, but " + std::to_string(text.columns()) +
                                      (text.columns() == 1 ? " number" : " numbers") + " in the first line; " + needed);
}

/// What makes a path of a single configuration.
std::string way_to_rest(const ConfigurationRows& rows) {
    if (rows.configurations.empty())
        return {};
    return std::string("; repeat the row") + (rows.stamps.empty() ? "" : " with a later time") +
           " to ask about this configuration at rest";
}

} // namespace

ConfigurationRows read_configurations(std::string_view text, const Robot& robot, std::size_t least) {
    const auto may_be_name = [&](std::string_view name) {
        return io::is_time_column(name) || JointColumns::is_name(robot, name);
    };
    io::ColumnTable rows_of_text(text, may_be_name);
    const std::vector<std::string>& names = rows_of_text.names();
    const std::size_t line = rows_of_text.line();
    if (names.empty())
        refuse_no_names(rows_of_text, robot);
    const JointTable table = at_line(line, [&] { return JointTable(names, robot); });
    const JointColumns columns = at_line(line, [&] { return JointColumns(table.names, robot, JointUnits::by_name); });
    ConfigurationRows rows;
    for (const std::string& warning : columns.warnings("columns"))
        rows.warnings.push_back("line " + std::to_string(line) + ": " + warning);
    while (const std::optional<io::TableRow> row = rows_of_text.next())
        at_line(row->line, [&] { read_configuration(*row, names, table, columns, rows); });
    if (rows.configurations.empty() && least == 1)
        throw InvalidInput("has no configuration");
    if (rows.configurations.size() < least)
        throw InvalidInput("a path needs at least two configurations, and there are " +
                           std::to_string(rows.configurations.size()) + way_to_rest(rows));
    return rows;
}

} // namespace chasles::robot
