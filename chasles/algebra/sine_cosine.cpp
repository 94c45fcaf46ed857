// Reduces the angle to a thirty-second of pi about zero by a table, then sums the Taylor series.
// Sources: docs/derivations/25-even-motions.md, "Sine and cosine"; docs/derivations/33-angles-in-double.md.
#include "chasles/algebra/sine_cosine.h"

#include <array>
#include <bit>
#include <cstdint>
#include <numbers>

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
constexpr int steps_of_turn = 4 * steps_of_quarter;

/// Of the multiples of a sixteenth of pi up to a whole turn.
const std::array<SineCosine<DoubleDouble>, steps_of_turn>& table() {
    static const auto values = [] {
        std::array<SineCosine<DoubleDouble>, steps_of_turn> all;
        for (int i = 0; i <= steps_of_quarter / 2; ++i) {
            const auto [sine, cosine] = series(quarter_turn() * DoubleDouble(double(i) / steps_of_quarter), 27);
            all[std::size_t(i)] = {sine, cosine};
            all[std::size_t(steps_of_quarter - i)] = {cosine, sine};
        }
        for (std::size_t i = steps_of_quarter; i < steps_of_turn; ++i) {
            const auto& [sine, cosine] = all[i - steps_of_quarter];
            all[i] = {cosine, -sine};
        }
        return all;
    }();
    return values;
}

/// The multiple of a sixteenth of pi that is next to an angle.
struct Multiple {
    double steps;
    const SineCosine<DoubleDouble>& values;
};

/// The sum with 1.5 * 2^52 is rounded to a whole number, and its last bits are those of this number.
Multiple nearest_multiple(double angle) {
    constexpr double whole = 0x1.8p52;
    const double shifted = angle * (2 * steps_of_quarter / std::numbers::pi) + whole;
    return {shifted - whole, table()[std::bit_cast<std::uint64_t>(shifted) % steps_of_turn]};
}

using Pair = detail::WordPair<double>;

/// An angle minus a multiple of a sixteenth of pi, which has four parts: the products of the first three with up to 20
/// bits are exact.
Pair rest_after(double steps, double angle) {
    const Pair first = detail::exact_sum(angle - steps * 0x1.921fb544p-3, -steps * 0x1.0b4611a6p-37);
    const Pair second = detail::exact_sum(first.high, -steps * 0x1.3198a2ep-72);
    return {second.high, second.low + first.low - steps * 0x1.b839a252049c1p-107};
}

/// S + C (x + sine_low) + S cosine_low for the values S and C of the table, without rounding the sum of both words.
struct AdditionTheorem {
    Pair x; ///< in halves: the product of the upper ones is exact
    double sine_low;
    double cosine_low;

    [[nodiscard]] Pair operator()(const DoubleDouble& own, const DoubleDouble& other) const {
        const Pair factor = detail::halves(other.high());
        const Pair sum = detail::ordered_sum(own.high(), factor.high * x.high);
        const double product_low = factor.high * x.low + (factor.low + other.low()) * (x.high + x.low);
        const double curved = other.high() * sine_low + own.high() * cosine_low;
        return {sum.high, sum.low + (own.low() + product_low) + curved};
    }
};

/// Sine and cosine of an angle in double, as pairs with relative errors below 2^-55.
SineCosine<Pair> pairs(double angle) {
    constexpr double largest = 0x1p17;
    if (std::abs(angle) > largest)
        return pairs(std::remainder(angle, 2 * std::numbers::pi));
    const auto& [steps, values] = nearest_multiple(angle);
    const auto [x, low] = rest_after(steps, angle);
    const double square = x * x, fourth = square * square; // terms in pairs, which do not wait for one another
    const double odd = (-1.0 / 6 + square * (1.0 / 120)) +
                       fourth * ((-1.0 / 5040 + square * (1.0 / 362880)) - fourth * (1.0 / 39916800));
    const double even =
        (-0.5 + square * (1.0 / 24)) + fourth * ((-1.0 / 720 + square * (1.0 / 40320)) - fourth * (1.0 / 3628800));
    const AdditionTheorem sum{detail::halves(x), low + x * (square * odd), square * even};
    return {sum(values.sine, values.cosine), sum(values.cosine, -values.sine)};
}

} // namespace

SineCosine<double> sine_cosine(double angle) {
    const auto [sine, cosine] = pairs(angle);
    return {sine.high + sine.low, cosine.high + cosine.low};
}

double tangent(double angle) {
    const auto [sine, cosine] = pairs(angle);
    const Pair a = detail::ordered_sum(sine.high, sine.low), b = detail::ordered_sum(cosine.high, cosine.low);
    const double quotient = a.high / b.high;
    const Pair product = detail::exact_product(quotient, b.high);
    return quotient + (a.high - product.high - product.low + (a.low - quotient * b.low)) / b.high;
}

SineCosine<DoubleDouble> sine_cosine(const DoubleDouble& angle) {
    const auto& [steps, values] = nearest_multiple(angle.high());
    const auto [rest, co_rest] = series(angle - quarter_turn() * DoubleDouble(steps / steps_of_quarter), 17);
    return {values.sine * co_rest + values.cosine * rest, values.cosine * co_rest - values.sine * rest};
}

} // namespace chasles::algebra
