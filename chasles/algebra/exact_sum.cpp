// Splits each product without error into two doubles of magnitude at most 1 and adds their mantissas as integers.
// The sign is read off after one pass that propagates all carries.
#include "chasles/algebra/exact_sum.h"

#include <cmath>

namespace chasles {

// fma gives the exact error of the product of the mantissas, which cannot underflow.
void ExactSum::add_product(double a, double b) {
    int exponent_a = 0;
    int exponent_b = 0;
    const double mantissa_a = std::frexp(a, &exponent_a);
    const double mantissa_b = std::frexp(b, &exponent_b);
    const double high = mantissa_a * mantissa_b;
    const double low = std::fma(mantissa_a, mantissa_b, -high);
    add_scaled(high, exponent_a + exponent_b);
    add_scaled(low, exponent_a + exponent_b);
}

int ExactSum::sign() const {
    // Propagates carries from the lowest digit. The final carry is negative if and only if the sum is negative.
    std::int64_t carry = 0;
    bool is_zero = true;
    for (const std::int64_t digit : digits_) {
        const std::int64_t total = digit + carry;
        carry = total >> 32; // rounds down, therefore the remaining digit is never negative
        is_zero = is_zero && (total & 0xffffffff) == 0;
    }
    if (carry < 0)
        return -1;
    return is_zero && carry == 0 ? 0 : 1;
}

// Splits the mantissa of 53 bits into two words of 32 bits.
void ExactSum::add_scaled(double value, int exponent) {
    if (value == 0.0)
        return;
    int own_exponent = 0;
    const double mantissa = std::frexp(std::abs(value), &own_exponent);
    const auto bits = static_cast<std::uint64_t>(std::ldexp(mantissa, 53));
    const int position = own_exponent + exponent - 53 - lowest_bit;
    add_at(bits & 0xffffffff, position, value < 0.0);
    add_at(bits >> 32, position + 32, value < 0.0);
}

// Splits a shifted word over two neighbouring digits. The digits have room for 2^28 products.
void ExactSum::add_at(std::uint64_t bits, int position, bool negative) {
    const std::uint64_t shifted = bits << (position % 32);
    const auto low = static_cast<std::int64_t>(shifted & 0xffffffff);
    const auto high = static_cast<std::int64_t>(shifted >> 32);
    const auto digit = static_cast<std::size_t>(position / 32);
    digits_[digit] += negative ? -low : low;
    digits_[digit + 1] += negative ? -high : high;
}

} // namespace chasles
