// The exact sign of a sum of products of doubles, whatever their exponents: nothing rounds, overflows or underflows.
// A fixed-point accumulator wide enough for every product (U. Kulisch, "Computer Arithmetic and Validity", 2008).
#pragma once

#include <array>
#include <cstdint>

namespace chasles {

/// Takes about a microsecond; meant for what a floating-point filter leaves undecided.
class ExactSum {
public:
    /// Adds a * b for finite a, b. At most 2^28 products fit.
    void add_product(double a, double b);

    /// -1, 0 or 1.
    [[nodiscard]] int sign() const;

private:
    void add_scaled(double value, int exponent);
    void add_at(std::uint64_t bits, int position, bool negative);

    /// Digits of 32 bits with room for carries; the lowest has the weight of the smallest product, 2^-2148, less the
    /// 64 bits by which the rounding error of a product may reach below it.
    static constexpr int lowest_bit = -2148 - 64;
    std::array<std::int64_t, 136> digits_{};
};

} // namespace chasles
