// Reads lines, words and numbers from text.
// std::from_chars does the rounding; strtod and streams depend on the locale.
#include "chasles/io/text_scan.h"

#include "chasles/base/invalid_input.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <utility>

namespace chasles::io {
namespace {

constexpr std::string_view blanks = " \t\r\n\v\f";
constexpr std::size_t longest_quote = 60;

// Whether a character separates words: blank, tab, or a line break.
bool is_blank(char c) {
    return c == ' ' || (c >= '\t' && c <= '\r');
}

// The word without a leading plus sign, which from_chars does not accept.
std::string_view without_plus(std::string_view word) {
    const bool has_plus = word.size() > 1 && word[0] == '+' && word[1] != '-' && word[1] != '+';
    return has_plus ? word.substr(1) : word;
}

template <typename Number>
std::from_chars_result scan(std::string_view word, Number& number) {
    return std::from_chars(word.data(), word.data() + word.size(), number);
}

// The decimal exponent, clamped to a range beyond all doubles.
std::int64_t exponent_of(std::string_view digits) {
    if (digits.empty())
        return 0;
    constexpr std::int64_t beyond_all = std::int64_t{1} << 62;
    return parse_integer(digits).value_or(digits.front() == '-' ? -beyond_all : beyond_all);
}

// Zero or infinity for a number out of range. from_chars does not distinguish both, but the place of the first digit
// does.
double beyond_range(std::string_view word) {
    const std::size_t mantissa_end = std::min(word.find_first_of("eE"), word.size());
    const auto point = static_cast<std::int64_t>(std::min(word.find('.'), mantissa_end));
    const auto digit = static_cast<std::int64_t>(word.find_first_of("123456789"));
    const std::string_view exponent = word.substr(std::min(mantissa_end + 1, word.size()));
    const double size = point - digit + exponent_of(exponent) > 0 ? HUGE_VAL : 0.0;
    return word.front() == '-' ? -size : size;
}

// The bytes of the character at the start of a text; 0 if it is not in UTF-8. Source: RFC 3629, section 4.
std::size_t character_size(std::string_view text) {
    const auto byte = [&](std::size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0U; };
    const unsigned first = byte(0);
    const bool is_first = first < 0x80 || (first >= 0xc2 && first <= 0xf4);
    const std::size_t size = !is_first ? 0 : 1U + (first >= 0xc2) + (first >= 0xe0) + (first >= 0xf0);
    const unsigned lowest = first == 0xe0 ? 0xa0 : first == 0xf0 ? 0x90 : 0x80;
    const unsigned highest = first == 0xed ? 0x9f : first == 0xf4 ? 0x8f : 0xbf;
    if (size > 1 && (byte(1) < lowest || byte(1) > highest))
        return 0;
    for (std::size_t i = 2; i < size; ++i)
        if ((byte(i) & 0xc0U) != 0x80)
            return 0;
    return size;
}

/// Whether a character acts on a terminal instead of being seen: control characters, line ends of Unicode, and marks
/// that turn the direction of writing.
bool is_unseen(std::string_view character) {
    using Range = std::pair<std::string_view, std::string_view>; // of characters of equal size
    static constexpr std::array ranges{Range("\x01", "\x1f"),
                                       Range("\x7f", "\x7f"),
                                       Range("\xc2\x80", "\xc2\x9f"),
                                       Range("\xd8\x9c", "\xd8\x9c"),
                                       Range("\xe2\x80\x8e", "\xe2\x80\x8f"),
                                       Range("\xe2\x80\xa8", "\xe2\x80\xae"),
                                       Range("\xe2\x81\xa6", "\xe2\x81\xa9")};
    return character.front() == '\0' || std::ranges::any_of(ranges, [&](const Range& range) {
               return character.size() == range.first.size() && range.first <= character && character <= range.second;
           });
}

} // namespace

// The whole word must be used: "1.5x" is not a number.
std::optional<double> parse_number(std::string_view word) {
    word = without_plus(word);
    double number = 0;
    const auto [end, error] = scan(word, number);
    if (word.empty() || end != word.data() + word.size())
        return std::nullopt;
    if (error == std::errc::result_out_of_range)
        return beyond_range(word);
    return error == std::errc() ? std::optional(number) : std::nullopt;
}

std::optional<double> parse_finite(std::string_view word) {
    const auto number = parse_number(word);
    return number && std::isfinite(*number) ? number : std::nullopt;
}

std::optional<std::int64_t> parse_integer(std::string_view word) {
    word = without_plus(word);
    std::int64_t number = 0;
    const auto [end, error] = scan(word, number);
    const bool is_whole = !word.empty() && error == std::errc() && end == word.data() + word.size();
    return is_whole ? std::optional(number) : std::nullopt;
}

bool has_decimal_comma(std::string_view word) {
    std::string with_points(word);
    std::ranges::replace(with_points, ',', '.');
    return with_points != word && !word.ends_with(',') && parse_finite(with_points).has_value();
}

std::string decimal_comma_hint(std::string_view text) {
    Words words(text);
    for (std::string_view word = words.next(); !word.empty(); word = words.next())
        if (has_decimal_comma(word))
            return "; write a decimal point";
    return "";
}

std::string one_line(std::string_view text) {
    std::string line;
    while (!text.empty()) {
        const std::string_view character = text.substr(0, std::max<std::size_t>(character_size(text), 1));
        if (is_blank(character.front()))
            line += ' ';
        else if (is_unseen(character))
            line += '?';
        else
            line += character;
        text.remove_prefix(character.size());
    }
    return line;
}

std::string in_quotes(std::string_view text) {
    const auto first = std::min(text.find_first_not_of(blanks), text.size());
    text = text.substr(first, text.find_last_not_of(blanks) + 1 - first);
    const bool is_long = text.size() > longest_quote;
    std::string shown = one_line(text.substr(0, longest_quote));
    for (char& c : shown)
        if (static_cast<unsigned char>(c) >= 0x80)
            c = '?'; // UTF-8 or binary data
    return "'" + shown + (is_long ? "...'" : "'");
}

std::string valid_utf8(std::string_view text) {
    std::string valid;
    while (!text.empty()) {
        const std::size_t size = character_size(text);
        valid.append(size > 0 ? text.substr(0, size) : "?");
        text.remove_prefix(std::max<std::size_t>(size, 1));
    }
    return valid;
}

std::string lower_case(std::string_view text) {
    std::string lower(text);
    for (char& c : lower)
        if (c >= 'A' && c <= 'Z')
            c = static_cast<char>(c - 'A' + 'a');
    return lower;
}

bool differ_by_a_slip(std::string_view a, std::string_view b) {
    if (a.size() < b.size())
        std::swap(a, b);
    const auto [first, second] = std::ranges::mismatch(a, b);
    const auto after = static_cast<std::size_t>(first - a.begin());
    if (after == a.size() || a.size() > b.size() + 1)
        return false;
    if (a.size() > b.size())
        return a.substr(after + 1) == b.substr(after);
    const bool are_swapped = after + 1 < a.size() && a[after] == b[after + 1] && a[after + 1] == b[after];
    return a.substr(after + 1) == b.substr(after + 1) || (are_swapped && a.substr(after + 2) == b.substr(after + 2));
}

std::string_view without_byte_order_mark(std::string_view text) {
    using namespace std::string_view_literals;
    constexpr std::string_view utf8 = "\xEF\xBB\xBF";
    if (text.starts_with("\xFF\xFE"sv) || text.starts_with("\xFE\xFF"sv) || text.starts_with("\0\0\xFE\xFF"sv))
        throw InvalidInput("is text in UTF-16 or UTF-32; save it as UTF-8");
    return text.starts_with(utf8) ? text.substr(utf8.size()) : text;
}

bool is_lfs_pointer(std::string_view bytes) {
    return bytes.starts_with("version https://git-lfs.github.com/spec/");
}

void fail_at_line(std::size_t line, const std::string& why) {
    throw InvalidInput("line " + std::to_string(line) + ": " + why);
}

// Blanks separate words; a word extends to the next blank.
std::string_view Words::next() {
    std::size_t start = 0;
    while (start < rest_.size() && is_blank(rest_[start]))
        ++start;
    std::size_t end = start;
    while (end < rest_.size() && !is_blank(rest_[end]))
        ++end;
    const std::string_view word = rest_.substr(start, end - start);
    rest_.remove_prefix(end);
    return word;
}

// The last line may have no line end. The line feed that was found is kept: a text without any is searched once.
bool Lines::next() {
    if (position_ >= text_.size())
        return false;
    if (line_feed_ < position_ || number_ == 0)
        line_feed_ = std::min(text_.find('\n', position_), text_.size());
    const std::string_view rest = text_.substr(position_, line_feed_ - position_);
    line_ = rest.substr(0, rest.find('\r'));
    position_ += line_.size() + 1;
    if (line_.size() < rest.size() && position_ == line_feed_)
        ++position_; // CR LF
    ++number_;
    return true;
}

} // namespace chasles::io
