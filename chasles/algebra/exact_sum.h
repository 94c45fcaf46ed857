// The exact sign of a sum of products of doubles with any exponents. No operation rounds, overflows or underflows.
// Source: the fixed-point accumulator of U. Kulisch, "Computer Arithmetic and Validity", 2008.
#pragma once

#include <array>
#include <cstdint>

namespace chasles {

/// One sum takes about a microsecond. Use it where a floating-point filter cannot decide.
class ExactSum {
public:
    /// Adds a * b for finite a and b. The accumulator has room for 2^28 products.
    void add_product(double a, double b);

    /// The sign of the sum: -1, 0 or 1.
    [[nodiscard]] int sign() const;

private:
    /// Adds value * 2^exponent.
    void add_scaled(double value, int exponent);
    /// Adds a word of 32 bits at a bit position.
    void add_at(std::uint64_t bits, int position, bool negative);

    /// The weight of the lowest bit. The smallest product is 2^-2148; the rounding error of a product has up to 64 more
    /// bits below it.
    static constexpr int lowest_bit = -2148 - 64;
    std::array<std::int64_t, 136> digits_{}; ///< digits of 32 bits with room for carries
};

} // namespace chasles
