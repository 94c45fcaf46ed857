// Numbers as messages print them, in any locale.
#pragma once

#include <array>
#include <charconv>
#include <string>

namespace chasles {

/// The shortest text that reads back as the same number.
inline std::string number_text(double number) {
    std::array<char, 32> text{};
    const auto [end, error] = std::to_chars(text.data(), text.data() + text.size(), number);
    return {text.data(), end};
}

/// At most `digits` significant digits (up to 17), as printf's %g.
inline std::string number_text(double number, int digits) {
    std::array<char, 32> text{};
    const auto [end, error] =
        std::to_chars(text.data(), text.data() + text.size(), number, std::chars_format::general, digits);
    return {text.data(), end};
}

} // namespace chasles
