// A number with a bound on its own error that holds for any rounding of the operations before. Running error analysis;
// source: N. Higham, "Accuracy and Stability of Numerical Algorithms", section 3.3. The library's templates accept this
// scalar unchanged.
#pragma once

#include "chasles/algebra/double_double.h"

#include <algorithm>

namespace chasles::test {

using algebra::DoubleDouble;

/// The relative error of sums and products is `unit`; quotients and roots have twice this error.
template <const double& unit>
class TrackedIn {
public:
    using Tracked = TrackedIn;

    TrackedIn() = default;
    /// A number with a rounding error of one unit.
    static Tracked rounded(const DoubleDouble& value) { return {value, 0, 1}; }
    TrackedIn(double exact) : value_(exact) {} // NOLINT(google-explicit-constructor): as for double-double

    [[nodiscard]] const DoubleDouble& value() const { return value_; }
    [[nodiscard]] double error() const { return error_; }

    friend Tracked operator+(const Tracked& a, const Tracked& b) {
        return {a.value_ + b.value_, a.error_ + b.error_, 1};
    }
    friend Tracked operator-(const Tracked& a, const Tracked& b) {
        return {a.value_ - b.value_, a.error_ + b.error_, 1};
    }
    friend Tracked operator-(const Tracked& a) { return Tracked() - a; }
    friend Tracked operator*(const Tracked& a, const Tracked& b) {
        return {a.value_ * b.value_, a.size() * b.error_ + b.size() * a.error_ + a.error_ * b.error_, 1};
    }
    friend Tracked operator/(const Tracked& a, const Tracked& b) {
        const DoubleDouble quotient = a.value_ / b.value_;
        const double size = std::abs(quotient.high());
        return {quotient, (a.error_ + size * b.error_) / (b.size() - b.error_), 2};
    }
    friend Tracked sqrt(const Tracked& a) {
        const DoubleDouble root = sqrt(a.value_);
        return {root, a.error_ == 0 ? 0 : a.error_ / root.high(), 2};
    }
    friend bool operator<(const Tracked& a, const Tracked& b) { return a.value_ < b.value_; }
    explicit operator double() const { return value_.high(); }

private:
    TrackedIn(const DoubleDouble& value, double carried, int units)
        : value_(value), error_((carried + units * unit * std::abs(value.high())) * (1 + 0x1p-40)) {}
    [[nodiscard]] double size() const { return std::abs(value_.high()) * (1 + 0x1p-50); }

    DoubleDouble value_;
    double error_ = 0;
};

/// The units of double-double (docs/derivations/10-error-bounds.md) and of double.
inline constexpr double tracked_unit = 5 * 0x1p-106;
inline constexpr double tracked_double_unit = 0x1p-53;
using Tracked = TrackedIn<tracked_unit>;
using TrackedDouble = TrackedIn<tracked_double_unit>;

} // namespace chasles::test
