// Numbers of about 106 bits: the unevaluated sum of two doubles.
// Sources: Dekker 1971; Joldes, Muller, Popescu, "Tight and rigorous error bounds for basic building blocks of
// double-word arithmetic", ACM TOMS 44(2), 2017 (algorithm numbers below are theirs).
#pragma once

#include "chasles/algebra/unit_roundoff.h"

#include <cfloat>
#include <cmath>

#if defined(__FAST_MATH__)
#error "chasles needs every operation rounded as it is written: compile without -ffast-math"
#endif

namespace chasles::algebra {

static_assert(FLT_EVAL_METHOD == 0, "chasles needs doubles that are rounded after every operation");

/// high + low with |low| <= half an ulp of high. Each operation has a relative error of at most 2^-101
/// (unit_roundoff<DoubleDouble>), away from overflow and underflow.
class DoubleDouble {
public:
    constexpr DoubleDouble() = default;
    constexpr DoubleDouble(double value) : high_(value) {} // NOLINT(google-explicit-constructor): widening is exact

    [[nodiscard]] constexpr double high() const { return high_; }
    [[nodiscard]] constexpr double low() const { return low_; }
    constexpr explicit operator double() const { return high_; }

    /// a + b without error, whatever their order.
    static DoubleDouble exact_sum(double a, double b) {
        const double sum = a + b;
        const double b_part = sum - a;
        return {sum, (a - (sum - b_part)) + (b - b_part)};
    }
    /// a * b without error.
    static DoubleDouble exact_product(double a, double b) {
        const double product = a * b;
        return {product, std::fma(a, b, -product)};
    }

    friend DoubleDouble operator-(const DoubleDouble& a) { return {-a.high_, -a.low_}; }
    friend DoubleDouble operator+(const DoubleDouble& a, const DoubleDouble& b) { // algorithm 6
        const DoubleDouble high = exact_sum(a.high_, b.high_);
        const DoubleDouble low = exact_sum(a.low_, b.low_);
        const DoubleDouble partial = ordered_sum(high.high_, high.low_ + low.high_);
        return ordered_sum(partial.high_, low.low_ + partial.low_);
    }
    friend DoubleDouble operator-(const DoubleDouble& a, const DoubleDouble& b) { return a + (-b); }
    friend DoubleDouble operator*(const DoubleDouble& a, const DoubleDouble& b) { // algorithm 12
        const DoubleDouble high = exact_product(a.high_, b.high_);
        const double cross = std::fma(a.low_, b.high_, std::fma(a.high_, b.low_, a.low_ * b.low_));
        return ordered_sum(high.high_, high.low_ + cross);
    }
    friend DoubleDouble operator/(const DoubleDouble& a, const DoubleDouble& b) { // algorithm 18 with one more step
        const double first = a.high_ / b.high_;
        const DoubleDouble rest = a - b * DoubleDouble(first);
        const double second = rest.high_ / b.high_;
        const double third = (rest - b * DoubleDouble(second)).high_ / b.high_;
        return exact_sum(first, second) + DoubleDouble(third);
    }
    friend DoubleDouble sqrt(const DoubleDouble& a) {
        if (!(a.high_ > 0))
            return {0.0, 0.0};
        const double root = std::sqrt(a.high_);
        const DoubleDouble rest = a - exact_product(root, root);
        const DoubleDouble corrected = exact_sum(root, rest.high_ / (2 * root));
        const DoubleDouble remainder = a - corrected * corrected;
        return corrected + DoubleDouble(remainder.high_ / (2 * root));
    }

    friend bool operator<(const DoubleDouble& a, const DoubleDouble& b) {
        return a.high_ < b.high_ || (a.high_ == b.high_ && a.low_ < b.low_);
    }
    friend bool operator>(const DoubleDouble& a, const DoubleDouble& b) { return b < a; }
    friend bool operator<=(const DoubleDouble& a, const DoubleDouble& b) { return !(b < a); }
    friend bool operator>=(const DoubleDouble& a, const DoubleDouble& b) { return !(a < b); }
    friend bool operator==(const DoubleDouble& a, const DoubleDouble& b) {
        return a.high_ == b.high_ && a.low_ == b.low_;
    }

private:
    constexpr DoubleDouble(double high, double low) : high_(high), low_(low) {}
    /// a + b without error if |a| >= |b|.
    static DoubleDouble ordered_sum(double a, double b) {
        const double sum = a + b;
        return {sum, b - (sum - a)};
    }
    double high_ = 0;
    double low_ = 0;
};

template <>
inline constexpr double unit_roundoff<DoubleDouble> = 0x1p-101;

} // namespace chasles::algebra
