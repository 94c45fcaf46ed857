// Reads tables by the names of their columns. docs/decisions/0090-columns-by-name.md has the rules.
#include "chasles/io/column_table.h"

#include "chasles/base/invalid_input.h"
#include "chasles/base/number_text.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace chasles::io {
namespace {

constexpr std::size_t longest_shown_header = 300;

bool is_blank_line(std::string_view line) {
    return line.find_first_not_of(" \t") == std::string_view::npos;
}

bool is_comment(std::string_view line) {
    const std::size_t first = line.find_first_not_of(" \t");
    return first != std::string_view::npos && line[first] == '#';
}

void drop_empty_cells_at_end(std::vector<std::string>& cells, std::size_t columns) {
    while (cells.size() > columns && cells.back().empty())
        cells.pop_back();
}

// Whether a first line has no names, but numbers with decimal commas.
bool has_only_decimal_commas(std::string_view line) {
    return std::ranges::any_of(std::array{Separator::semicolon, Separator::blanks}, [&](Separator separator) {
        std::vector<std::string> cells = split_cells(line, separator);
        drop_empty_cells_at_end(cells, 1);
        const auto is_one = [](const std::string& cell) { return has_decimal_comma(cell); };
        return cells.size() > 1 && std::ranges::any_of(cells, is_one) &&
               std::ranges::all_of(cells, [&](const auto& cell) { return is_one(cell) || parse_number(cell); });
    });
}

// A cell after its mark of a comment.
std::string_view after_mark(std::string_view cell) {
    return cell.substr(std::min(cell.find_first_not_of('#'), cell.size()));
}

bool may_be_number(std::string_view cell) {
    return parse_number(cell).has_value() || has_decimal_comma(cell);
}

// Whether a cell is written as errors of spreadsheets are: "#N/A", "#REF!", "#NAME?", "#NV", "####".
bool is_spreadsheet_error(std::string_view cell) {
    const std::string_view text = after_mark(cell);
    if (!cell.starts_with('#') || cell.size() < 2 || cell.find_first_of(" \t") != std::string_view::npos)
        return false;
    return text.empty() || text.ends_with('!') || text.ends_with('?') || text.find('/') != std::string_view::npos ||
           text == "NV";
}

// Whether a line that begins with # may be a row whose first cell is an error of a spreadsheet: the cell is written so,
// or it is no number while all others are numbers. No spreadsheet writes a blank after the #.
bool may_begin_with_error(const std::vector<std::string>& cells) {
    const std::string_view first = after_mark(cells.front());
    const bool is_word = cells.size() > 1 && !first.empty() && first.front() != ' ' && first.front() != '\t';
    return is_spreadsheet_error(cells.front()) ||
           (is_word && !may_be_number(first) &&
            std::ranges::all_of(cells.begin() + 1, cells.end(),
                                [](const auto& cell) { return may_be_number(cell) || is_spreadsheet_error(cell); }));
}

std::string doubt_about_error(const std::string& cell) {
    return "begins with " + in_quotes(cell) +
           ": it may be a cell with an error of a spreadsheet, or a comment; mend the cell or delete the line, or "
           "begin "
           "the comment with # and a blank";
}

// The comment without its mark.
std::string_view inside_of(std::string_view comment) {
    return comment.substr(std::min(comment.find_first_not_of(" \t#"), comment.size()));
}

bool all_empty(const std::vector<std::string>& cells) {
    return std::ranges::all_of(cells, [](const std::string& cell) { return cell.empty(); });
}

std::string list_of(std::span<const std::string> names) {
    std::string text;
    for (const std::string& name : names)
        text += (text.empty() ? "" : ", ") + name;
    return text;
}

// A comment that can be read as a header, or no names.
std::vector<std::string> names_in_comment(std::string_view comment) {
    try {
        std::vector<std::string> names = split_cells(comment, separator_of(comment));
        drop_empty_cells_at_end(names, 0);
        return names;
    } catch (const InvalidInput&) { // prose with commas and semicolons
        return {};
    }
}

// Gives a column the place of a wanted name. The wanted name itself counts more than another name for the same.
void take_place(std::span<const std::string> names, std::size_t column, const std::string& wanted,
                std::optional<std::size_t>& place, std::vector<std::string>& ignored) {
    const auto is_itself = [&](std::size_t other) { return lower_case(names[other]) == wanted; };
    if (place && is_itself(*place) == is_itself(column))
        throw InvalidInput("the header " + shown_names(names) + " has two columns for " + wanted + ": " +
                           in_quotes(names[*place]) + " and " + in_quotes(names[column]));
    if (place)
        ignored.push_back(names[is_itself(*place) ? column : *place]);
    if (!place || is_itself(column))
        place = column;
}

// The first name that would be a missing one without its unit.
std::string unit_as_reason(std::span<const std::string> names, std::span<const std::string> missing,
                           const std::function<std::string(std::string_view)>& meaning) {
    for (const std::string& name : names)
        if (const auto [plain, unit] = split_unit(name);
            unit && std::ranges::find(missing, meaning(plain)) != missing.end())
            return "; the unit of " + in_quotes(name) + " is not read: convert the numbers, and leave it out";
    return {};
}

void require_places(std::span<const std::string> names, const NamedColumns& columns,
                    std::span<const std::string> wanted, std::size_t optional_from,
                    const std::function<std::string(std::string_view)>& meaning) {
    std::vector<std::string> missing;
    for (std::size_t i = 0; i < optional_from; ++i)
        if (!columns.places[i])
            missing.push_back(wanted[i]);
    if (!missing.empty())
        throw InvalidInput("the header " + shown_names(names) + " has no column " + list_of(missing) +
                           "; it needs the columns " + list_of(wanted.first(optional_from)) + " in any order" +
                           (optional_from < wanted.size() ? ", and may have " + list_of(wanted.subspan(optional_from))
                                                          : std::string()) +
                           unit_as_reason(names, missing, meaning));
}

/// A unit in brackets belongs to the name before it, also after a blank.
std::vector<std::string> with_their_units(std::vector<std::string> cells) {
    std::vector<std::string> names;
    for (std::string& cell : cells)
        if (!names.empty() && (cell.starts_with('[') || cell.starts_with('(')))
            names.back() += " " + cell;
        else
            names.push_back(std::move(cell));
    return names;
}

// The text of a table. The bytes of a binary file would be quoted as the names of its columns.
std::string_view table_text(std::string_view bytes) {
    const std::string_view text = without_byte_order_mark(bytes);
    if (text.find('\0') == std::string_view::npos)
        return text; // also a table whose first column is called PAR1
    if (text.starts_with("PAR1"))
        throw InvalidInput("is a Parquet file, which is no text: write the table as CSV, or read it in Python "
                           "(chasles.distributed, or pandas and arrays)");
    throw InvalidInput("is no text: it has zero bytes, as spreadsheets (.xlsx), compressed files and text in UTF-16 "
                       "have; save the table as CSV in UTF-8");
}

} // namespace

ColumnTable::ColumnTable(std::string_view text, std::function<bool(std::string_view)> is_name,
                         std::string_view text_column)
    : lines_(table_text(text)), is_name_(std::move(is_name)), text_column_(text_column) {
    std::vector<Comment> comments;
    bool has_line = lines_.next();
    if (has_line && take_separator(lines_.line()))
        has_line = lines_.next();
    for (; has_line && (is_comment(lines_.line()) || is_blank_line(lines_.line())); has_line = lines_.next())
        if (is_comment(lines_.line()))
            comments.push_back({lines_.number(), lines_.line()});
    if (has_line)
        read_first_line(comments);
}

// Excel's "sep=;" is no row.
bool ColumnTable::take_separator(std::string_view line) {
    const std::size_t first = line.find_first_not_of(" \t\"");
    if (first == std::string_view::npos || lower_case(line.substr(first, 4)) != "sep=")
        return false;
    const std::string_view named = line.substr(first + 4, 1);
    if (named.empty() || std::string_view(",;\t ").find(named) == std::string_view::npos)
        fail_at_line(lines_.number(),
                     "names the separator " + in_quotes(named) + "; commas, semicolons, tabs and blanks are read");
    separator_ = static_cast<Separator>(named.front());
    has_separator_ = true;
    return true;
}

// A line of numbers is a row, unless the numbers are names too.
void ColumnTable::read_first_line(const std::vector<Comment>& comments) {
    const std::string_view line = without_comment(lines_.line());
    line_ = lines_.number();
    if (has_only_decimal_commas(line))
        fail_at_line(line_, in_quotes(line) + " has decimal commas; write decimal points");
    try {
        if (!has_separator_)
            separator_ = separator_of(line);
    } catch (const InvalidInput& error) {
        fail_at_line(line_, "the header " + in_quotes(line) + " " + error.what());
    }
    std::vector<std::string> cells = with_their_units(split_cells(line, separator_));
    drop_empty_cells_at_end(cells, 1);
    columns_ = cells.size();
    is_at_row_ = std::ranges::all_of(cells, [](const std::string& cell) { return parse_number(cell).has_value(); }) &&
                 !std::ranges::all_of(cells, [&](const std::string& cell) { return is_name_(cell); });
    if (is_at_row_)
        take_header_from(comments, line);
    else
        names_ = std::move(cells);
    has_text_ = std::ranges::any_of(names_, [&](const auto& name) { return lower_case(name) == text_column_; });
}

// Comments before a row of numbers: one of them may be the header.
void ColumnTable::take_header_from(const std::vector<Comment>& comments, std::string_view row) {
    for (const auto& [line, comment] : comments) {
        if (const std::vector<std::string> cells = cells_in(comment);
            cells.size() == columns_ && is_spreadsheet_error(cells.front()))
            fail_at_line(line, doubt_about_error(cells.front()));
        std::vector<std::string> names = names_in_comment(inside_of(comment));
        const auto known = static_cast<std::size_t>(std::ranges::count_if(names, is_name_));
        if (names.size() == columns_ && 2 * known >= columns_) {
            if (!names_.empty() && names_ != names)
                fail_at_line(line, "the comments in the lines " + std::to_string(line_) + " and " +
                                       std::to_string(line) + " both may be the header: " + shown_names(names_) +
                                       " and " + shown_names(names));
            names_ = std::move(names);
            line_ = line;
        } else if (known >= 4 && 2 * known >= names.size()) {
            fail_at_line(line, "the comment " + shown_names(names) + " may be the header, but it has " +
                                   std::to_string(names.size()) + " names, and the first row " + in_quotes(row) +
                                   " has " + std::to_string(columns_) + " columns");
        }
    }
}

std::vector<std::string> ColumnTable::cells_in(std::string_view line) const {
    std::vector<std::string> cells = split_cells(line, separator_);
    drop_empty_cells_at_end(cells, columns_);
    return cells;
}

// A line that begins with # may be a row: with an error of a spreadsheet, or with a column of texts.
std::optional<TableRow> ColumnTable::row_of_comment() const {
    TableRow row{lines_.number(), cells_in(lines_.line()), {}};
    if (row.cells.size() != columns_)
        return std::nullopt;
    if (may_begin_with_error(row.cells))
        row.doubt = doubt_about_error(row.cells.front());
    else if (has_text_)
        row.doubt = "begins with #: it may be a comment, or a row; put its first cell in quotes, or leave the line out";
    return row.doubt.empty() ? std::nullopt : std::optional(std::move(row));
}

std::optional<TableRow> ColumnTable::next() {
    while (is_at_row_ || lines_.next()) {
        is_at_row_ = false;
        if (is_comment(lines_.line())) {
            if (auto row = row_of_comment())
                return row;
            continue;
        }
        TableRow row{lines_.number(), cells_in(has_text_ ? lines_.line() : without_comment(lines_.line())), {}};
        if (!all_empty(row.cells))
            return row;
    }
    return std::nullopt;
}

NamedColumns find_columns(std::span<const std::string> names, std::span<const std::string> wanted,
                          std::size_t optional_from, const std::function<std::string(std::string_view)>& meaning) {
    require_different(names);
    NamedColumns columns{std::vector<std::optional<std::size_t>>(wanted.size()), {}};
    for (std::size_t i = 0; i < names.size(); ++i) {
        const auto found = std::ranges::find(wanted, meaning(names[i]));
        if (found == wanted.end())
            columns.ignored.push_back(names[i]);
        else
            take_place(names, i, *found, columns.places[static_cast<std::size_t>(found - wanted.begin())],
                       columns.ignored);
    }
    require_places(names, columns, wanted, optional_from, meaning);
    return columns;
}

NameWithUnit split_unit(std::string_view name) {
    const char open = name.ends_with(']') ? '[' : name.ends_with(')') ? '(' : '\0';
    const std::size_t begin = open == '\0' ? std::string_view::npos : name.rfind(open);
    if (begin == std::string_view::npos)
        return {name, std::nullopt};
    const std::string_view inside = name.substr(begin + 1, name.size() - begin - 2);
    const std::size_t first = std::min(inside.find_first_not_of(' '), inside.size());
    return {name.substr(0, name.substr(0, begin).find_last_not_of(' ') + 1),
            lower_case(inside.substr(first, inside.find_last_not_of(' ') + 1 - first))};
}

std::string shown_names(std::span<const std::string> names) {
    std::string text = one_line(list_of(names));
    for (char& c : text)
        if (static_cast<unsigned char>(c) >= 0x80)
            c = '?'; // UTF-8 or binary data
    return text.size() > longest_shown_header ? "'" + text.substr(0, longest_shown_header) + "...'" : "'" + text + "'";
}

void require_different(std::span<const std::string> names) {
    std::vector<std::string> sorted(names.begin(), names.end());
    std::erase(sorted, "");
    std::ranges::sort(sorted);
    if (const auto twice = std::ranges::adjacent_find(sorted); twice != sorted.end())
        throw InvalidInput("the column " + in_quotes(*twice) + " comes twice in the header " + shown_names(names));
}

void require_cells(const TableRow& row, std::size_t columns) {
    if (!row.doubt.empty())
        throw InvalidInput(row.doubt);
    if (row.cells.size() != columns)
        throw InvalidInput(std::to_string(row.cells.size()) + (row.cells.size() == 1 ? " column" : " columns") +
                           " found, " + std::to_string(columns) + " expected");
}

double cell_number(const std::string& cell, const std::string& name) {
    if (const auto number = parse_finite(cell))
        return *number;
    throw InvalidInput(one_line(name) + ": not a finite number: " + in_quotes(cell) + decimal_comma_hint(cell));
}

void add_stamp(double stamp, const std::string& name, std::vector<double>& stamps) {
    constexpr double largest_count = 0x1p53; // of which doubles tell each from the next one
    if (!stamps.empty() && !(stamps.back() < stamp))
        throw InvalidInput(
            one_line(name) + ": must increase, but is " + number_text(stamp) + " after " + number_text(stamps.back()) +
            (stamp >= largest_count ? "; doubles do not tell such numbers apart: count from the first one" : ""));
    if (!stamps.empty() && !std::isfinite(stamp - stamps.front()))
        throw InvalidInput(one_line(name) + ": " + number_text(stamp) + " is too far from the first stamp");
    stamps.push_back(stamp);
}

void warn_of_ignored(std::span<const std::string> ignored, std::size_t line, const std::string& why,
                     std::vector<std::string>& warnings) {
    if (!ignored.empty())
        warnings.push_back("line " + std::to_string(line) + ": ignored columns: " + shown_names(ignored) + "; " + why);
}

} // namespace chasles::io
