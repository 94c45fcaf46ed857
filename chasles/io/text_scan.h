// Lines, words and numbers out of text. Numbers are correctly rounded and do not depend on the locale.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace chasles::io {

/// The number that the whole word spells, correctly rounded to double; nothing if it spells none. It may be NaN or
/// infinite: "nan", "inf", or a number beyond the range of double. A leading plus sign is allowed.
std::optional<double> parse_number(std::string_view word);

/// As parse_number, but only for finite numbers.
std::optional<double> parse_finite(std::string_view word);

/// The integer that the whole word spells, if it fits.
std::optional<std::int64_t> parse_integer(std::string_view word);

/// Text for a message: within quotes, printable, in one line, shortened to a few words.
std::string in_quotes(std::string_view text);

/// The same text with line breaks and other control characters replaced, so that it fits one line.
std::string one_line(std::string_view text);

/// `text` in lower case (ASCII letters only).
std::string lower_case(std::string_view text);

/// Throws InvalidInput "line N: WHY".
[[noreturn]] void fail_at_line(std::size_t line, const std::string& why);

/// Takes a text apart into words that blanks separate.
class Words {
public:
    explicit Words(std::string_view text) : rest_(text) {}

    /// The next word; empty at the end.
    std::string_view next();

    /// What has not been taken yet.
    [[nodiscard]] std::string_view rest() const { return rest_; }

private:
    std::string_view rest_;
};

/// Takes a text apart into lines, without their line ends (LF or CR LF).
class Lines {
public:
    explicit Lines(std::string_view text) : text_(text) {}

    /// Moves on to the next line; false at the end of the text.
    bool next();

    [[nodiscard]] std::string_view line() const { return line_; }
    [[nodiscard]] std::size_t number() const { return number_; }     ///< of the current line, from 1
    [[nodiscard]] std::size_t position() const { return position_; } ///< where the next line starts, in bytes

private:
    std::string_view text_;
    std::string_view line_;
    std::size_t position_ = 0;
    std::size_t number_ = 0;
};

} // namespace chasles::io
