// A table of numbers with named columns, as robots and loggers write it: any separator, `#` comments, columns in any
// order. Rows are read one at a time, so that a caller can report an invalid row and continue with the next row.
#pragma once

#include "chasles/io/csv_table.h"
#include "chasles/io/text_scan.h"

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace chasles::io {

/// One row. It has as many cells as the table has columns, unless `cells` has another size, which is a fault of the
/// row.
struct TableRow {
    std::size_t line = 0; ///< line number, from 1
    std::vector<std::string> cells;
    std::string doubt; ///< why the line, which begins with `#`, may be a comment or a row; mostly empty
};

/// Reads a table. The header is the first line that is neither blank nor a comment, or a comment before the first row
/// of numbers ("# timestamp tx ty tz qx qy qz qw"). Blank lines, comments, a byte order mark, separators at the ends of
/// lines and lines of separators alone are skipped. A first line "sep=;" names the separator.
///
/// A line after the header that begins with `#` and has as many cells as the header is no comment where its first cell
/// may be an error of a spreadsheet ("#N/A", "#REF!"): it is a row with a doubt.
class ColumnTable {
public:
    /// `is_name` accepts the names that a header of this kind of table has. If there is a column of the name `text`,
    /// `#` begins no comment within a row. Throws InvalidInput for a header that can be read in two ways, and for
    /// Parquet and other binary files.
    ColumnTable(std::string_view text, std::function<bool(std::string_view)> is_name,
                std::string_view text_column = {});

    /// The names of the columns. Empty if the table has no header.
    [[nodiscard]] const std::vector<std::string>& names() const { return names_; }
    /// The number of the line of the header or, without a header, of the first row.
    [[nodiscard]] std::size_t line() const { return line_; }
    /// The columns of a table without a header: the cells of its first row.
    [[nodiscard]] std::size_t columns() const { return columns_; }
    [[nodiscard]] Separator separator() const { return separator_; }

    /// The next row, or empty at the end of the text.
    std::optional<TableRow> next();

private:
    struct Comment {
        std::size_t line;
        std::string_view text;
    };

    bool take_separator(std::string_view line);
    void read_first_line(const std::vector<Comment>& comments);
    void take_header_from(const std::vector<Comment>& comments, std::string_view row);
    [[nodiscard]] std::optional<TableRow> row_of_comment() const;
    [[nodiscard]] std::vector<std::string> cells_in(std::string_view line) const;

    Lines lines_;
    std::function<bool(std::string_view)> is_name_;
    std::string_view text_column_;
    std::vector<std::string> names_;
    std::size_t line_ = 1;
    std::size_t columns_ = 0;
    Separator separator_ = Separator::comma;
    bool has_separator_ = false; ///< the first line names it
    bool has_text_ = false;
    bool is_at_row_ = false; ///< the first row is the current line
};

/// What a header gives for the columns that a reader wants.
struct NamedColumns {
    std::vector<std::optional<std::size_t>> places; ///< of each wanted column
    std::vector<std::string> ignored;               ///< names of the other columns, as the file writes them
};

/// Finds columns by name. `meaning` returns the wanted name that a name of the file stands for, or an empty text. Where
/// a file has the wanted name itself and another name for it, the wanted name counts. The wanted names from
/// `optional_from` on may be missing. Throws InvalidInput if columns are missing or come twice.
NamedColumns find_columns(std::span<const std::string> names, std::span<const std::string> wanted,
                          std::size_t optional_from, const std::function<std::string(std::string_view)>& meaning);

/// The name of a column and the unit at its end: "spin [rad]" and "Spin(rad)" have the unit "rad".
struct NameWithUnit {
    std::string_view name;           ///< without the unit and without blanks at its end
    std::optional<std::string> unit; ///< in small letters; empty without brackets
};

/// Takes a unit in brackets off the name of a column.
NameWithUnit split_unit(std::string_view name);

/// The names for a message, in quotes and in one line.
std::string shown_names(std::span<const std::string> names);

/// Throws InvalidInput if two of the names are equal.
void require_different(std::span<const std::string> names);

/// Throws InvalidInput if the row may be a comment, or has another number of cells.
void require_cells(const TableRow& row, std::size_t columns);

/// The finite number in a cell. Throws InvalidInput "NAME: WHY".
double cell_number(const std::string& cell, const std::string& name);

/// Adds the time stamp of a row. Throws InvalidInput if the stamp does not increase, or is too far from the first one.
void add_stamp(double stamp, const std::string& name, std::vector<double>& stamps);

/// The warning about columns that are not read, if there are any.
void warn_of_ignored(std::span<const std::string> ignored, std::size_t line, const std::string& why,
                     std::vector<std::string>& warnings);

} // namespace chasles::io
