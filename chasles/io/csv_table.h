// Rows of comma-separated values (RFC 4180, one row per line), read one at a time.
// A caller can therefore report an invalid row and continue with the next row.
#pragma once

#include "chasles/io/text_scan.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace chasles::io {

/// One row: the cells without surrounding blanks and quotes.
struct CsvRow {
    std::size_t line = 0; ///< line number, from 1
    std::vector<std::string> cells;
};

/// Reads the rows of a text. It skips blank lines and a byte order mark at the start.
class CsvTable {
public:
    explicit CsvTable(std::string_view text);

    /// The next row, or empty at the end of the text.
    std::optional<CsvRow> next();

private:
    Lines lines_;
};

/// The cells of one line. A cell in double quotes may contain commas, and two double quotes stand for one.
std::vector<std::string> split_csv(std::string_view line);

/// `text` as one cell. It is quoted if it contains a comma, a quote, a line break, or blanks at its ends.
std::string csv_cell(std::string_view text);

} // namespace chasles::io
