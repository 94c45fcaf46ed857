// Doubles as certificates write them.
#pragma once

#include <array>
#include <cstdio>
#include <string>

namespace chasles::certificate {

/// In C's hexadecimal form, without rounding; 0 for -0.
inline std::string hexadecimal(double value) {
    std::array<char, 40> text{};
    static_cast<void>(std::snprintf(text.data(), text.size(), "%a", value + 0.0));
    return text.data();
}

} // namespace chasles::certificate
