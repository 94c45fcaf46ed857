// Reads paths and lists of motions. Columns are found by their names, therefore columns cannot be confused.
// Every message contains the file name and the line number. Source: docs/decisions/0090-columns-by-name.md.
#include "chasles/io/motion_files.h"

#include "chasles/base/invalid_input.h"
#include "chasles/io/column_table.h"
#include "chasles/io/pose_columns.h"
#include "chasles/io/pose_text.h"
#include "chasles/io/read_file.h"

#include <algorithm>
#include <array>

namespace chasles::io {
namespace {

constexpr std::size_t pose_size = 7;
constexpr const char* pose_header = "x,y,z,qw,qx,qy,qz";

bool is_pose_column(std::string_view name) {
    return !pose_column(name).empty();
}

// "x0" to "qz1", then "id": two poses and the name of their motion.
std::vector<std::string> motion_columns() {
    std::vector<std::string> names;
    const std::vector<std::string> of_pose = pose_columns();
    for (const char* const end : {"0", "1"})
        for (std::size_t i = 0; i < pose_size; ++i)
            names.push_back(of_pose[i] + end);
    names.emplace_back("id");
    return names;
}

// A pose's name with 0 for the start or 1 for the goal.
std::string motion_column(std::string_view name) {
    if (lower_case(name) == "id")
        return "id";
    const auto [with_end, unit] = split_unit(name);
    if (!with_end.ends_with('0') && !with_end.ends_with('1'))
        return "";
    const std::string without_end(with_end.substr(0, with_end.size() - 1));
    const std::string column = pose_column(unit ? without_end + '[' + *unit + ']' : without_end);
    return column.empty() || column == "t" ? "" : column + with_end.back();
}

bool is_motion_column(std::string_view name) {
    return !motion_column(name).empty();
}

/// The columns of a table of poses or motions, and the names that messages give them.
struct PoseTable {
    std::vector<std::string> names; ///< as in the file
    NamedColumns columns;

    [[nodiscard]] bool has(std::size_t wanted) const { return columns.places[wanted].has_value(); }
    [[nodiscard]] const std::string& name(std::size_t wanted) const { return names[columns.places[wanted].value()]; }
    [[nodiscard]] double number(const TableRow& row, std::size_t wanted) const {
        return cell_number(row.cells[columns.places[wanted].value()], name(wanted));
    }
    /// The pose whose first column is the wanted column `first`.
    [[nodiscard]] Pose pose(const TableRow& row, std::size_t first) const {
        std::array<double, pose_size> numbers{};
        for (std::size_t i = 0; i < pose_size; ++i)
            numbers[i] = number(row, first + i);
        return pose_from_numbers(numbers);
    }
};

// Roll, pitch and yaw have no order and no unit that all programs share.
std::string why_no_angles(std::span<const std::string> names) {
    for (const std::string& name : names)
        for (const std::string_view angle : {"roll", "pitch", "yaw", "euler", "rpy"})
            if (lower_case(name).find(angle) != std::string::npos)
                return "; the angles of the column " + in_quotes(name) +
                       " are not read, because programs do not agree on the order of their turns: write a quaternion";
    return "";
}

PoseTable table_of(const ColumnTable& text, std::span<const std::string> names, std::span<const std::string> wanted,
                   const std::function<std::string(std::string_view)>& meaning) {
    try {
        return {{names.begin(), names.end()}, find_columns(names, wanted, wanted.size() - 1, meaning)};
    } catch (const InvalidInput& error) {
        fail_at_line(text.line(), error.what() + why_no_angles(names));
    }
}

[[noreturn]] void refuse_without_header(const ColumnTable& text, const std::string& columns) {
    if (text.columns() == 0)
        throw InvalidInput("has no header; it needs the columns " + columns + " in any order");
    fail_at_line(text.line(), "there is no header, but " + std::to_string(text.columns()) +
                                  (text.columns() == 1 ? " number" : " numbers") +
                                  " in the first line; write the names " + columns +
                                  " of the columns in their order above");
}

// The names of a table of poses that has none. Where two readings are possible, the message names both.
std::vector<std::string> names_without_header(const ColumnTable& text, WithoutHeader without_header) {
    const bool is_tum = without_header == WithoutHeader::tum && text.separator() == Separator::blanks;
    if (text.columns() == 8 && is_tum)
        return {"timestamp", "tx", "ty", "tz", "qx", "qy", "qz", "qw"};
    const std::string stamp = text.columns() == 8 ? "t," : "";
    if (text.columns() == 7 || text.columns() == 8)
        fail_at_line(text.line(), "there is no header, and " + std::to_string(text.columns()) + " numbers may be " +
                                      stamp + pose_header + " or " + stamp +
                                      "x,y,z,qx,qy,qz,qw (as in TUM trajectories): write the names in the line above");
    refuse_without_header(text, pose_header);
}

// Reads one row of a path. Messages start with the line number.
void read_pose(const TableRow& row, const PoseTable& table, Path& path) {
    try {
        require_cells(row, table.names.size());
        if (table.has(pose_size))
            add_stamp(table.number(row, pose_size), table.name(pose_size), path.stamps);
        path.poses.push_back(table.pose(row, 0));
    } catch (const InvalidInput& error) {
        fail_at_line(row.line, error.what());
    }
}

// Reads one row of a list of motions. An invalid row sets `motion.error` and throws nothing.
void read_motion(const TableRow& row, const PoseTable& table, MotionRow& motion) {
    try {
        require_cells(row, table.names.size());
        motion.start = table.pose(row, 0);
        motion.goal = table.pose(row, pose_size);
    } catch (const InvalidInput& error) {
        motion.error = "line " + std::to_string(row.line) + ": " + error.what();
    }
}

std::string id_of(const TableRow& row, const PoseTable& table, std::size_t number) {
    const auto place = table.columns.places[2 * pose_size];
    return place && *place < row.cells.size() ? row.cells[*place] : std::to_string(number);
}

// Runs a reader on the content of a file and puts the file name at the start of every message.
template <typename Read>
auto read_naming_file(const std::filesystem::path& file, const Read& read) {
    const std::string text = read_file(file);
    try {
        auto found = read(text);
        for (std::string& warning : found.warnings)
            warning.insert(0, shown_name(file) + ": ");
        return found;
    } catch (const InvalidInput& error) {
        fail_in_file(file, error.what());
    }
}

// Calls `read` for each row that is left.
template <typename Read>
void for_each_row(ColumnTable& table, const Read& read) {
    while (const auto row = table.next())
        read(*row); // NOLINT(bugprone-unchecked-optional-access): the condition of the loop is the check
}

} // namespace

Path read_path(std::string_view content, WithoutHeader without_header) {
    ColumnTable text(content, is_pose_column);
    const PoseTable table =
        table_of(text, text.names().empty() ? names_without_header(text, without_header) : text.names(), pose_columns(),
                 pose_column);
    Path path;
    warn_of_ignored(table.columns.ignored, text.line(), "x, y, z, qw, qx, qy, qz and t are read", path.warnings);
    std::size_t last_line = text.line();
    for_each_row(text, [&](const TableRow& row) {
        read_pose(row, table, path);
        last_line = row.line;
    });
    if (path.poses.size() < 2)
        fail_at_line(last_line, "the path has " + std::to_string(path.poses.size()) +
                                    (path.poses.size() == 1 ? " pose" : " poses") + ", but needs at least two");
    return path;
}

MotionList read_motions(std::string_view content) {
    const std::vector<std::string> wanted = motion_columns();
    ColumnTable text(content, is_motion_column, "id");
    if (text.names().empty())
        refuse_without_header(text, "x0,y0,z0,qw0,qx0,qy0,qz0,x1,y1,z1,qw1,qx1,qy1,qz1");
    const PoseTable table = table_of(text, text.names(), wanted, motion_column);
    MotionList motions;
    warn_of_ignored(table.columns.ignored, text.line(), "x0 to qz1 and id are read", motions.warnings);
    for_each_row(text, [&](const TableRow& row) {
        MotionRow motion;
        motion.id = id_of(row, table, motions.rows.size());
        read_motion(row, table, motion);
        motions.rows.push_back(std::move(motion));
    });
    return motions;
}

Path load_path(const std::filesystem::path& file) {
    const std::string extension = lower_case(file.extension().string());
    const bool may_be_tum = extension == ".tum" || extension == ".txt";
    return read_naming_file(file, [&](std::string_view text) {
        return read_path(text, may_be_tum ? WithoutHeader::tum : WithoutHeader::refused);
    });
}

MotionList load_motions(const std::filesystem::path& file) {
    return read_naming_file(file, read_motions);
}

} // namespace chasles::io
