// Reads lines, words and numbers from text. Numbers are correctly rounded and do not depend on the locale.
// Functions that quote text in messages are also here.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace chasles::io {

/// The number in a word, correctly rounded to double. Empty if the whole word is not a number. The result may be NaN or
/// infinite, for "nan", "inf", or a number beyond the range of double. A leading plus sign is allowed.
std::optional<double> parse_number(std::string_view word);

/// Like parse_number, but empty for NaN and infinity.
std::optional<double> parse_finite(std::string_view word);

/// The integer in a word. Empty if the whole word is not an integer or does not fit 64 bits.
std::optional<std::int64_t> parse_integer(std::string_view word);

/// "1,5" for 1.5. A comma at the end separates.
bool has_decimal_comma(std::string_view word);

/// The way out of an error for a text with such a word, after a semicolon; empty for other texts.
std::string decimal_comma_hint(std::string_view text);

/// Text for a message: in quotes, printable, in one line, at most 60 characters.
std::string in_quotes(std::string_view text);

/// The text in one line: characters that act on a terminal instead of being seen are replaced.
std::string one_line(std::string_view text);

/// The text with a question mark for each byte that is not in UTF-8.
std::string valid_utf8(std::string_view text);

/// `text` in lower case (ASCII letters only).
std::string lower_case(std::string_view text);

/// Whether one letter more, less or other, or two neighbours swapped, make one name of the other.
bool differ_by_a_slip(std::string_view a, std::string_view b);

/// The text without the byte order mark of UTF-8. Throws InvalidInput for the marks of UTF-16 and UTF-32.
std::string_view without_byte_order_mark(std::string_view text);

/// Whether these are the first bytes of a Git LFS pointer, which stands for a file that was not fetched.
bool is_lfs_pointer(std::string_view bytes);
inline constexpr const char* lfs_way_out =
    "is a Git LFS pointer, not the file itself; `git lfs pull` brings the content";

/// Throws InvalidInput "line N: WHY".
[[noreturn]] void fail_at_line(std::size_t line, const std::string& why);

/// Splits a text into words at blanks.
class Words {
public:
    explicit Words(std::string_view text) : rest_(text) {}

    /// The next word, or an empty word at the end of the text.
    std::string_view next();

    /// The text after the last word.
    [[nodiscard]] std::string_view rest() const { return rest_; }

private:
    std::string_view rest_;
};

/// Splits a text into lines without line ends (LF, CR LF or CR).
class Lines {
public:
    explicit Lines(std::string_view text) : text_(text) {}

    /// Moves to the next line. Returns false at the end of the text.
    bool next();

    [[nodiscard]] std::string_view line() const { return line_; }
    [[nodiscard]] std::size_t number() const { return number_; }     ///< of the current line, from 1
    [[nodiscard]] std::size_t position() const { return position_; } ///< start of the next line in bytes

private:
    std::string_view text_;
    std::string_view line_;
    std::size_t position_ = 0;
    std::size_t line_feed_ = 0; ///< the next one from `position_` on, or the end of the text
    std::size_t number_ = 0;
};

} // namespace chasles::io
