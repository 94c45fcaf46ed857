#include "chasles/robot/joint_path_file.h"

#include "chasles/base/invalid_input.h"
#include "chasles/io/csv_table.h"
#include "chasles/io/read_file.h"

#include <algorithm>
#include <set>

namespace chasles::robot {

namespace {

/// The columns of a header.
struct Columns {
    bool has_stamps = false;
    std::vector<std::size_t> variables; ///< of the columns after the stamps
};

Columns columns_of(const io::CsvRow& header, const Robot& robot) {
    Columns columns;
    std::set<std::string> names;
    for (std::size_t i = 0; i < header.cells.size(); ++i) {
        const std::string& name = header.cells[i];
        if (!names.insert(name).second)
            io::fail_at_line(header.line, "the column " + io::in_quotes(name) + " comes twice");
        const auto variables = robot.variables();
        const auto found = std::ranges::find(variables, name, &RobotVariable::name);
        if (found != variables.end())
            columns.variables.push_back(std::size_t(found - variables.begin()));
        else if (name == "t" && i == 0)
            columns.has_stamps = true;
        else
            io::fail_at_line(header.line, "the robot has no variable " + io::in_quotes(name) +
                                              "; fixed joints and joints that follow others have none");
    }
    if (columns.variables.empty() && !robot.variables().empty())
        io::fail_at_line(header.line, "the header names no variable of the robot");
    return columns;
}

double number_in(const io::CsvRow& row, const io::CsvRow& header, std::size_t column) {
    const std::optional<double> number = io::parse_finite(row.cells[column]);
    if (!number)
        io::fail_at_line(row.line,
                         header.cells[column] + ": " + io::in_quotes(row.cells[column]) + " is not a finite number");
    return *number;
}

} // namespace

ConfigurationRows read_configurations(std::string_view text, const Robot& robot) {
    io::CsvTable table(text);
    const std::optional<io::CsvRow> header = table.next();
    if (!header)
        throw InvalidInput("has no header");
    const Columns columns = columns_of(*header, robot);
    ConfigurationRows rows;
    while (const std::optional<io::CsvRow> row = table.next()) {
        if (row->cells.size() != header->cells.size())
            io::fail_at_line(row->line, "has " + std::to_string(row->cells.size()) + " cells, and the header has " +
                                            std::to_string(header->cells.size()));
        const std::size_t first = columns.has_stamps ? 1 : 0;
        if (columns.has_stamps) {
            const double stamp = number_in(*row, *header, 0);
            if (!rows.stamps.empty() && !(stamp > rows.stamps.back()))
                io::fail_at_line(row->line, "t: must be greater than in the row before");
            rows.stamps.push_back(stamp);
        }
        Configuration values = robot.neutral();
        for (std::size_t i = 0; i < columns.variables.size(); ++i)
            values[Eigen::Index(columns.variables[i])] = number_in(*row, *header, first + i);
        rows.configurations.push_back(std::move(values));
    }
    if (rows.configurations.size() < 2)
        throw InvalidInput("a path needs at least two configurations, and there are " +
                           std::to_string(rows.configurations.size()));
    return rows;
}

ConfigurationRows load_configurations(const std::filesystem::path& file, const Robot& robot) {
    const std::string text = io::read_file(file);
    try {
        return read_configurations(text, robot);
    } catch (const InvalidInput& error) {
        io::fail_in_file(file, error.what());
    }
}

} // namespace chasles::robot
