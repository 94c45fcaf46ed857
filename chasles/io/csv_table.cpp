// Reads and writes comma-separated values.
// Source: docs/decisions/0021-csv.md explains why no library is used.
#include "chasles/io/csv_table.h"

#include <algorithm>

namespace chasles::io {
namespace {

// The text without blanks at its ends.
std::string_view trimmed(std::string_view text) {
    while (!text.empty() && (text.front() == ' ' || text.front() == '\t'))
        text.remove_prefix(1);
    while (!text.empty() && (text.back() == ' ' || text.back() == '\t'))
        text.remove_suffix(1);
    return text;
}

// The end of the first cell of `text`: the first comma outside quotes, or the end of the text.
std::size_t cell_end(std::string_view text) {
    // A doubled quote inside quotes toggles twice and therefore has no effect here.
    bool is_inside_quotes = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] == '"')
            is_inside_quotes = !is_inside_quotes;
        if (text[i] == ',' && !is_inside_quotes)
            return i;
    }
    return text.size();
}

// The content of a cell without surrounding blanks and quotes.
std::string unquoted(std::string_view cell) {
    cell = trimmed(cell);
    if (cell.size() < 2 || cell.front() != '"' || cell.back() != '"')
        return std::string(cell);
    std::string text;
    for (std::size_t i = 1; i + 1 < cell.size(); ++i) {
        text.push_back(cell[i]);
        if (cell[i] == '"' && cell[i + 1] == '"')
            ++i;
    }
    return text;
}

} // namespace

CsvTable::CsvTable(std::string_view text) : lines_(without_byte_order_mark(text)) {}

std::optional<CsvRow> CsvTable::next() {
    while (lines_.next())
        if (!trimmed(lines_.line()).empty())
            return CsvRow{lines_.number(), split_csv(lines_.line())};
    return std::nullopt;
}

std::vector<std::string> split_csv(std::string_view line) {
    std::vector<std::string> cells;
    while (true) {
        const std::size_t end = cell_end(line);
        cells.push_back(unquoted(line.substr(0, end)));
        if (end == line.size())
            return cells;
        line.remove_prefix(end + 1);
    }
}

std::string csv_cell(std::string_view text) {
    const bool is_plain = text.find_first_of(",\"\r\n") == std::string_view::npos && trimmed(text) == text;
    if (is_plain)
        return std::string(text);
    std::string cell = "\"";
    for (const char c : text)
        cell.append(c == '"' ? 2 : 1, c);
    return cell + '"';
}

} // namespace chasles::io
