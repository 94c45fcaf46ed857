// Reads paths and lists of motions from CSV files. Headers must match exactly, therefore columns cannot be confused.
// Every message contains the file name and the line number.
#include "chasles/io/motion_files.h"

#include "chasles/base/invalid_input.h"
#include "chasles/base/number_text.h"
#include "chasles/io/csv_table.h"
#include "chasles/io/pose_text.h"
#include "chasles/io/read_file.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace chasles::io {
namespace {

// The exact headers. Quaternions have the order w, x, y, z.
constexpr std::string_view path_header = "x,y,z,qw,qx,qy,qz";
constexpr std::string_view stamped_path_header = "t,x,y,z,qw,qx,qy,qz";
constexpr std::string_view motion_header = "x0,y0,z0,qw0,qx0,qy0,qz0,x1,y1,z1,qw1,qx1,qy1,qz1";

using Cells = std::span<const std::string>;

// The cells without the first cell, the id.
Cells without_first(Cells cells) {
    return cells.subspan(1);
}

// Whether the cells are exactly the names of a header.
bool is_header(Cells cells, std::string_view header) {
    const std::vector<std::string> names = split_csv(header);
    return std::equal(cells.begin(), cells.end(), names.begin(), names.end());
}

// The numbers of a row. The header gives their count and the names for messages.
std::vector<double> numbers_in(Cells cells, std::string_view header) {
    const std::vector<std::string> names = split_csv(header);
    if (cells.size() != names.size())
        throw InvalidInput(std::to_string(cells.size()) + (cells.size() == 1 ? " column" : " columns") + " found, " +
                           std::to_string(names.size()) + " expected");
    std::vector<double> numbers;
    for (std::size_t i = 0; i < cells.size(); ++i) {
        const auto number = parse_finite(cells[i]);
        if (!number)
            throw InvalidInput(names[i] + ": not a finite number: " + in_quotes(cells[i]));
        numbers.push_back(*number);
    }
    return numbers;
}

// Adds the stamp of a row. The distance of two stamps has to be finite too.
void add_stamp(double stamp, std::vector<double>& stamps) {
    if (!stamps.empty() && !(stamps.back() < stamp))
        throw InvalidInput("t: must increase, but is " + number_text(stamp) + " after " + number_text(stamps.back()));
    if (!stamps.empty() && !std::isfinite(stamp - stamps.front()))
        throw InvalidInput("t: " + number_text(stamp) + " is too far from the first stamp");
    stamps.push_back(stamp);
}

// Reads one row of a path. Messages start with the line number.
void read_pose(const CsvRow& row, bool has_stamps, Path& path) {
    try {
        const std::vector<double> numbers = numbers_in(row.cells, has_stamps ? stamped_path_header : path_header);
        if (has_stamps)
            add_stamp(numbers.front(), path.stamps);
        path.poses.push_back(pose_from_numbers(std::span(numbers).last(7)));
    } catch (const InvalidInput& error) {
        fail_at_line(row.line, error.what());
    }
}

// Reads one row of a list of motions. An invalid row sets `motion.error` and throws nothing.
void read_motion(const CsvRow& row, bool has_id, MotionRow& motion) {
    try {
        const Cells cells = has_id ? without_first(row.cells) : Cells(row.cells);
        const std::vector<double> numbers = numbers_in(cells, motion_header);
        motion.start = pose_from_numbers(std::span(numbers).first(7));
        motion.goal = pose_from_numbers(std::span(numbers).last(7));
    } catch (const InvalidInput& error) {
        motion.error = "line " + std::to_string(row.line) + ": " + error.what();
    }
}

// Checks the header. Returns whether it begins with the optional column `first`.
bool read_header(CsvTable& table, std::string_view names, const std::string& first) {
    const auto header = table.next();
    if (header && is_header(header->cells, names))
        return false;
    const bool has_first = header && header->cells.front() == first && is_header(without_first(header->cells), names);
    if (!has_first)
        fail_at_line(header ? header->line : 1,
                     "the header must be " + std::string(names) + ", with an optional first column " + first);
    return true;
}

// Runs a reader on the content of a file and puts the file name at the start of every message.
template <typename Read>
auto read_naming_file(const std::filesystem::path& file, const Read& read) {
    const std::string text = read_file(file);
    try {
        return read(text);
    } catch (const InvalidInput& error) {
        fail_in_file(file, error.what());
    }
}

// Calls `read` for each row that is left.
template <typename Read>
void for_each_row(CsvTable& table, const Read& read) {
    while (const auto row = table.next())
        read(*row); // NOLINT(bugprone-unchecked-optional-access): the condition of the loop is the check
}

} // namespace

Path read_path(std::string_view text) {
    CsvTable table(text);
    const bool has_stamps = read_header(table, path_header, "t");
    Path path;
    std::size_t last_line = 1;
    for_each_row(table, [&](const CsvRow& row) {
        read_pose(row, has_stamps, path);
        last_line = row.line;
    });
    if (path.poses.size() < 2)
        fail_at_line(last_line, "the path has " + std::to_string(path.poses.size()) +
                                    (path.poses.size() == 1 ? " pose" : " poses") + ", but needs at least two");
    return path;
}

std::vector<MotionRow> read_motions(std::string_view text) {
    CsvTable table(text);
    const bool has_id = read_header(table, motion_header, "id");
    std::vector<MotionRow> motions;
    for_each_row(table, [&](const CsvRow& row) {
        MotionRow motion;
        motion.id = has_id ? row.cells.front() : std::to_string(motions.size());
        read_motion(row, has_id, motion);
        motions.push_back(std::move(motion));
    });
    return motions;
}

Path load_path(const std::filesystem::path& file) {
    return read_naming_file(file, read_path);
}

std::vector<MotionRow> load_motions(const std::filesystem::path& file) {
    return read_naming_file(file, read_motions);
}

} // namespace chasles::io
