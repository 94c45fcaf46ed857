// Dyadic numbers: integers of any size times powers of two. Sums, differences and products of doubles do not round.
// The exact stage computes with them (docs/derivations/12-exact-stage.md).
#pragma once

#if defined(__GNUC__) && !defined(__clang__) // false alarm for copies of short integers, which need no allocation
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif
#include <boost/multiprecision/cpp_int.hpp>
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic pop
#endif
#include <cmath>

namespace chasles::algebra {

/// The number mantissa * 2^exponent. Division is not available; halving is exact.
class Dyadic {
public:
    /// Integers of at most 1024 bits need no allocation; most integers of the exact stage are shorter.
    using Integer = boost::multiprecision::number<
        boost::multiprecision::cpp_int_backend<1024, 0, boost::multiprecision::signed_magnitude,
                                               boost::multiprecision::unchecked>,
        boost::multiprecision::et_off>;

    Dyadic() = default;
    /// The exact value of x, which must be finite.
    Dyadic(double x) { // NOLINT(google-explicit-constructor)
        if (x == 0)
            return;
        exponent_ = std::ilogb(x) - 52;
        auto digits = static_cast<std::int64_t>(std::ldexp(x, -exponent_));
        for (; digits % 2 == 0; ++exponent_)
            digits /= 2;
        mantissa_ = digits;
    }

    /// The number mantissa * 2^exponent. The mantissa may be even.
    Dyadic(Integer mantissa, int exponent) : mantissa_(std::move(mantissa)), exponent_(exponent) {}

    [[nodiscard]] const Integer& mantissa() const { return mantissa_; }
    [[nodiscard]] int exponent() const { return exponent_; }
    /// -1, 0 or 1.
    [[nodiscard]] int sign() const { return mantissa_.sign(); }
    /// The number of binary digits of the mantissa.
    [[nodiscard]] unsigned digits() const { return sign() == 0 ? 0 : unsigned(msb(Integer(abs(mantissa_)))) + 1; }
    /// The exact product with 2^power.
    [[nodiscard]] Dyadic times_power_of_two(int power) const { return Dyadic(mantissa_, exponent_ + power); }

    /// Shifts the mantissa with the greater exponent to the smaller exponent and adds both.
    Dyadic& operator+=(const Dyadic& b) {
        if (b.sign() == 0)
            return *this;
        if (sign() == 0)
            return *this = b;
        if (exponent_ > b.exponent_) {
            mantissa_ <<= unsigned(exponent_ - b.exponent_);
            exponent_ = b.exponent_;
        }
        if (exponent_ == b.exponent_)
            mantissa_ += b.mantissa_;
        else
            mantissa_ += b.mantissa_ << unsigned(b.exponent_ - exponent_);
        return *this;
    }
    /// Changes the sign in place, without a copy of the mantissa.
    void negate() { mantissa_.backend().negate(); }

    friend Dyadic operator+(Dyadic a, const Dyadic& b) { return std::move(a += b); }
    friend Dyadic operator-(Dyadic a) {
        a.negate();
        return a;
    }
    friend Dyadic operator-(const Dyadic& a, Dyadic b) {
        b.negate();
        return std::move(b += a);
    }
    friend Dyadic operator*(const Dyadic& a, const Dyadic& b) {
        if (a.sign() == 0 || b.sign() == 0)
            return {};
        return Dyadic(a.mantissa_ * b.mantissa_, a.exponent_ + b.exponent_);
    }
    friend bool operator<(const Dyadic& a, const Dyadic& b) { return (a - b).sign() < 0; }
    friend bool operator==(const Dyadic& a, const Dyadic& b) { return (a - b).sign() == 0; }

    /// The greatest double <= this number, for magnitudes up to 1.
    [[nodiscard]] double rounded_down() const {
        const double near = truncated();
        return *this < Dyadic(near) ? std::nextafter(near, -2.0) : near;
    }
    /// The least double >= this number, for magnitudes up to 1.
    [[nodiscard]] double rounded_up() const { return -(-*this).rounded_down(); }

    /// The next double towards zero; the nearest double if the result is subnormal.
    [[nodiscard]] double truncated() const {
        if (sign() == 0)
            return 0;
        const Integer size = abs(mantissa_);
        const int excess = std::max(0, static_cast<int>(msb(size)) - 52);
        const double digits = static_cast<double>(static_cast<std::int64_t>(Integer(size >> unsigned(excess))));
        return std::ldexp(sign() < 0 ? -digits : digits, exponent_ + excess);
    }

private:
    Integer mantissa_{};
    int exponent_ = 0;
};

} // namespace chasles::algebra
