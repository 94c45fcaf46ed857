// Reduces the angle to a sixteenth of pi about zero by a table, then sums the Taylor series.
// Source: docs/derivations/25-even-motions.md, "Sine and cosine".
#include "chasles/algebra/sine_cosine.h"

#include <array>

namespace chasles::algebra {

namespace {

/// A quarter turn, with an error below 2^-109.
DoubleDouble quarter_turn() {
    return DoubleDouble::exact_sum(0x1.921fb54442d18p+0, 0x1.1a62633145c07p-54);
}

/// The Taylor series in powers of an angle. `terms` of them leave less than 2^-106 for angles up to pi / 4 (27) and up
/// to pi / 32 (17).
SineCosine<DoubleDouble> series(const DoubleDouble& angle, int terms) {
    static const auto inverse_factorials = [] {
        std::array<DoubleDouble, 28> inverses;
        DoubleDouble factorial(1.0); // exact: 27! has 71 bits without its factors of two
        inverses[0] = factorial;
        for (std::size_t n = 1; n < inverses.size(); ++n) {
            factorial = factorial * DoubleDouble(double(n));
            inverses[n] = DoubleDouble(1.0) / factorial;
        }
        return inverses;
    }();
    const DoubleDouble square = -(angle * angle);
    DoubleDouble sine, cosine;
    for (int n = terms; n >= 0; --n) { // Horner's rule for both
        DoubleDouble& sum = n % 2 == 1 ? sine : cosine;
        sum = sum * square + inverse_factorials[std::size_t(n)];
    }
    return {sine * angle, cosine};
}

constexpr int steps_of_quarter = 8;

/// Of the multiples of a sixteenth of pi up to a quarter turn.
const std::array<SineCosine<DoubleDouble>, steps_of_quarter + 1>& table() {
    static const auto values = [] {
        std::array<SineCosine<DoubleDouble>, steps_of_quarter + 1> all;
        for (int i = 0; i <= steps_of_quarter / 2; ++i) {
            const auto [sine, cosine] = series(quarter_turn() * DoubleDouble(double(i) / steps_of_quarter), 27);
            all[std::size_t(i)] = {sine, cosine};
            all[std::size_t(steps_of_quarter - i)] = {cosine, sine};
        }
        return all;
    }();
    return values;
}

} // namespace

SineCosine<DoubleDouble> sine_cosine(const DoubleDouble& angle) {
    const double step = quarter_turn().high() / steps_of_quarter;
    const double steps = std::nearbyint(angle.high() / step);
    const double quarters = std::floor(steps / steps_of_quarter);
    const auto& [of_table, co_of_table] = table()[static_cast<std::size_t>(steps - steps_of_quarter * quarters)];
    const auto [rest, co_rest] = series(angle - quarter_turn() * DoubleDouble(steps / steps_of_quarter), 17);
    const DoubleDouble sine = of_table * co_rest + co_of_table * rest;
    const DoubleDouble cosine = co_of_table * co_rest - of_table * rest;
    switch (static_cast<int>(quarters - 4 * std::floor(quarters / 4))) {
    case 0:
        return {sine, cosine};
    case 1:
        return {cosine, -sine};
    case 2:
        return {-sine, -cosine};
    default:
        return {-cosine, sine};
    }
}

/// The angle in double is off by some 2^-52: its sine is the error up to 2^-158.
DoubleDouble angle_of(const SineCosine<DoubleDouble>& direction) {
    const DoubleDouble rough(std::atan2(direction.sine.high(), direction.cosine.high()));
    const auto [sine, cosine] = sine_cosine(rough);
    return rough + (direction.sine * cosine - direction.cosine * sine);
}

} // namespace chasles::algebra
