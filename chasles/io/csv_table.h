// Rows of comma-separated values (RFC 4180, one row a line), taken one at a time so that a bad row costs only itself.
#pragma once

#include "chasles/io/text_scan.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace chasles::io {

/// One row: its cells without surrounding blanks and quotes.
struct CsvRow {
    std::size_t line = 0; ///< from 1
    std::vector<std::string> cells;
};

/// Walks through the rows of a text; blank lines are passed over, and so is a byte order mark at the start.
class CsvTable {
public:
    explicit CsvTable(std::string_view text);

    /// The next row; nothing at the end.
    std::optional<CsvRow> next();

private:
    Lines lines_;
};

/// The cells of one line. A cell within double quotes may hold commas, and doubled quotes stand for one.
std::vector<std::string> split_csv(std::string_view line);

/// `text` as one cell: in double quotes where it holds a comma, a quote, or blanks at its ends.
std::string csv_cell(std::string_view text);

} // namespace chasles::io
