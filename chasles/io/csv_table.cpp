// Splits lines into cells, and writes cells.
// Source: docs/decisions/0021-csv.md explains why no library is used.
#include "chasles/io/csv_table.h"

#include "chasles/base/invalid_input.h"

#include <algorithm>

namespace chasles::io {
namespace {

constexpr bool is_space(char c) {
    return c == ' ' || c == '\t';
}

// The text without blanks at its ends.
std::string_view trimmed(std::string_view text) {
    while (!text.empty() && is_space(text.front()))
        text.remove_prefix(1);
    while (!text.empty() && is_space(text.back()))
        text.remove_suffix(1);
    return text;
}

// The place of the first character outside quotes that `is_wanted` accepts, or the end of the text.
template <typename Wanted>
std::size_t find_outside_quotes(std::string_view text, const Wanted& is_wanted) {
    // A doubled quote inside quotes toggles twice and therefore has no effect here.
    bool is_inside_quotes = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] == '"')
            is_inside_quotes = !is_inside_quotes;
        if (!is_inside_quotes && is_wanted(text[i]))
            return i;
    }
    return text.size();
}

bool has_outside_quotes(std::string_view text, char wanted) {
    return find_outside_quotes(text, [&](char c) { return c == wanted; }) < text.size();
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

std::vector<std::string> split_at_blanks(std::string_view line) {
    std::vector<std::string> cells;
    for (line = trimmed(line); !line.empty(); line = trimmed(line)) {
        const std::size_t end = find_outside_quotes(line, is_space);
        cells.push_back(unquoted(line.substr(0, end)));
        line.remove_prefix(end);
    }
    return cells;
}

// With tabs between names, a blank may be a part of a name or a separator too.
void require_no_blank_beside_tabs(std::string_view line) {
    while (!line.empty()) {
        const std::size_t end = find_outside_quotes(line, [](char c) { return c == '\t'; });
        const std::string_view cell = trimmed(line.substr(0, end));
        if (find_outside_quotes(cell, is_space) < cell.size())
            throw InvalidInput("has tabs and blanks between the names, so that " + std::string(cell) +
                               " may be one name or more: separate the names by one of them, or quote them");
        line.remove_prefix(std::min(end + 1, line.size()));
    }
}

} // namespace

Separator separator_of(std::string_view line) {
    const bool has_comma = has_outside_quotes(line, ','), has_semicolon = has_outside_quotes(line, ';');
    line = trimmed(line);
    if (has_comma && has_semicolon)
        throw InvalidInput("has commas and semicolons between the names: separate the names by one of them");
    if (has_semicolon)
        return Separator::semicolon;
    if (has_comma || find_outside_quotes(line, is_space) == line.size())
        return Separator::comma;
    if (!has_outside_quotes(line, '\t'))
        return Separator::blanks;
    require_no_blank_beside_tabs(line);
    return Separator::tab;
}

std::vector<std::string> split_cells(std::string_view line, Separator separator) {
    if (separator == Separator::blanks)
        return split_at_blanks(line);
    std::vector<std::string> cells;
    while (true) {
        const std::size_t end = find_outside_quotes(line, [&](char c) { return c == static_cast<char>(separator); });
        cells.push_back(unquoted(line.substr(0, end)));
        if (end == line.size())
            return cells;
        line.remove_prefix(end + 1);
    }
}

std::vector<std::string> split_csv(std::string_view line) {
    return split_cells(line, Separator::comma);
}

std::string_view without_comment(std::string_view line) {
    return line.substr(0, find_outside_quotes(line, [](char c) { return c == '#'; }));
}

std::string csv_cell(std::string_view text) {
    const bool is_plain = text.find_first_of(",\"\r\n#") == std::string_view::npos && trimmed(text) == text;
    if (is_plain)
        return std::string(text);
    std::string cell = "\"";
    for (const char c : text)
        cell.append(c == '"' ? 2 : 1, c);
    return cell + '"';
}

} // namespace chasles::io
