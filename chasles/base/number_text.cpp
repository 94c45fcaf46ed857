// Takes the digits from printf, and no more, because its decimal point depends on the locale. std::to_chars needs
// tables of 100 kB for precise digits, a fifth of the WebAssembly module.
#include "chasles/base/number_text.h"

#include <algorithm>
#include <array>
#include <cfloat>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace chasles {

namespace {

/// A number as d1.d2d3... times a power of ten.
struct Decimal {
    std::string digits; ///< without zeros at the end, except for zero itself
    int exponent;

    [[nodiscard]] std::string scientific() const {
        std::array<char, 16> power{};
        std::snprintf(power.data(), power.size(), "e%+03d", exponent);
        const std::string rest = digits.substr(1);
        return digits[0] + (rest.empty() ? "" : "." + rest) + power.data();
    }
    [[nodiscard]] std::string fixed() const {
        if (exponent < 0)
            return "0." + std::string(std::size_t(-exponent - 1), '0') + digits;
        const auto whole = std::size_t(exponent) + 1;
        if (digits.size() <= whole)
            return digits + std::string(whole - digits.size(), '0');
        return digits.substr(0, whole) + "." + digits.substr(whole);
    }
};

Decimal rounded(double magnitude, int digits) {
    std::array<char, 48> text{};
    std::snprintf(text.data(), text.size(), "%.*e", digits - 1, magnitude);
    const char* const power = std::strchr(text.data(), 'e');
    Decimal decimal{"", std::atoi(power + 1)};
    for (const char* next = text.data(); next != power; ++next)
        if (*next >= '0' && *next <= '9')
            decimal.digits += *next;
    decimal.digits.resize(std::max<std::size_t>(1, decimal.digits.find_last_not_of('0') + 1));
    return decimal;
}

double number_of(const Decimal& decimal) {
    const std::string text = decimal.scientific();
    double number = 0;
    std::from_chars(text.data(), text.data() + text.size(), number);
    return number;
}

std::string with_sign(double number, const std::string& text) {
    return (std::signbit(number) ? "-" : "") + text;
}

std::string not_finite(double number) {
    return std::isnan(number) ? "nan" : "inf";
}

} // namespace

std::string number_text(double number) {
    if (!std::isfinite(number))
        return with_sign(number, not_finite(number));
    const double magnitude = std::abs(number);
    int digits = magnitude < DBL_MIN ? 1 : 15; // normal numbers keep 15 digits, and 17 digits keep every number
    Decimal decimal = rounded(magnitude, digits);
    while (number_of(decimal) != magnitude)
        decimal = rounded(magnitude, ++digits);
    const std::string fixed = decimal.fixed(), scientific = decimal.scientific();
    return with_sign(number, fixed.size() <= scientific.size() ? fixed : scientific);
}

std::string number_text(double number, int digits) {
    if (!std::isfinite(number))
        return with_sign(number, not_finite(number));
    const Decimal decimal = rounded(std::abs(number), digits);
    const bool is_fixed = decimal.exponent >= -4 && decimal.exponent < digits;
    return with_sign(number, is_fixed ? decimal.fixed() : decimal.scientific());
}

std::string time_text(double time) {
    // A double has not quite sixteen digits, and brackets are printed with as many.
    constexpr double fewest = 12, most = 16, after_point = 10;
    const double before_point = 1 + std::floor(std::log10(std::max(1.0, std::abs(time))));
    return number_text(time, int(std::clamp(before_point + after_point, fewest, most)));
}

} // namespace chasles
