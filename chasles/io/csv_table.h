// Cells of one line of a table: the separators, and cells in quotes (RFC 4180, one row per line).
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace chasles::io {

/// What stands between two cells. Any number of blanks and tabs is one separator `blanks`.
enum class Separator : char { comma = ',', semicolon = ';', tab = '\t', blanks = ' ' };

/// The separator of a line of names. Throws InvalidInput where two readings are possible. A line of one word has
/// commas.
Separator separator_of(std::string_view line);

/// The cells of one line, without surrounding blanks and quotes. A cell in double quotes may contain separators, and
/// two double quotes stand for one.
std::vector<std::string> split_cells(std::string_view line, Separator separator);

/// The same for commas.
std::vector<std::string> split_csv(std::string_view line);

/// The line before the first `#` that is outside quotes.
std::string_view without_comment(std::string_view line);

/// `text` as one cell of comma-separated values. It is quoted if it contains a comma, a quote, a line break, a `#`, or
/// blanks at its ends.
std::string csv_cell(std::string_view text);

} // namespace chasles::io
