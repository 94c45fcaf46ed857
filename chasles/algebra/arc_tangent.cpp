// Turns the direction back by an angle of a table to within 1/32 of the axis, then sums the Taylor series.
// Source: docs/derivations/33-angles-in-double.md.
#include "chasles/algebra/arc_tangent.h"

#include <array>
#include <cmath>

namespace chasles::algebra {

namespace {

constexpr int parts = 16;

/// The arc tangents of 0, 1/16, ... 1. Each Newton step leaves a sixth of the cube of the error.
const std::array<DoubleDouble, parts + 1>& arc_tangents() {
    static const auto values = [] {
        std::array<DoubleDouble, parts + 1> all;
        for (int i = 0; i <= parts; ++i) {
            const DoubleDouble tangent(double(i) / parts);
            const DoubleDouble length = sqrt(DoubleDouble(1.0) + tangent * tangent);
            DoubleDouble angle = tangent;
            for (int step = 0; step < 4; ++step) {
                const auto [sine, cosine] = sine_cosine(angle);
                angle = angle + (tangent * cosine - sine) / length;
            }
            all[std::size_t(i)] = angle;
        }
        return all;
    }();
    return values;
}

DoubleDouble sum_of(const DoubleDouble& great, const DoubleDouble& small) {
    const auto sum = detail::ordered_sum(great.high(), small.high());
    return DoubleDouble::exact_sum(sum.high, sum.low + (great.low() + small.low()));
}

/// a / b for the pairs of a numerator and a denominator.
DoubleDouble quotient(const detail::WordPair<double>& a, const detail::WordPair<double>& b) {
    const double high = a.high / b.high, inverse = 1 / b.high;
    const auto product = detail::exact_product(high, b.high);
    const double rest = a.high - product.high - product.low + (a.low - high * b.low);
    return DoubleDouble::exact_sum(high, rest * inverse);
}

/// The arc tangent of y / x for 0 <= y <= x. Not a number if one of them is none, or both are infinite.
DoubleDouble arc_tangent_to_one(double y, double x) {
    constexpr double tiny = 0x1p-40; // such a tangent is its own arc tangent
    if (y <= x * tiny)
        return x > 0 ? y / x : 0;
    const double scale = x > 0x1p900 ? 0x1p-200 : x < 0x1p-900 ? 0x1p200 : 1; // the products below stay in range
    y *= scale;
    x *= scale;
    const double ratio = y / x;
    if (!(ratio <= 1))
        return ratio;
    const auto i = static_cast<std::size_t>(std::floor(ratio * parts + 0.5));
    const double tangent = double(i) / parts;
    const auto across = detail::exact_product(tangent, x);
    const auto along = detail::exact_product(tangent, y);
    const auto denominator = detail::ordered_sum(x, along.high);
    const DoubleDouble rest =
        quotient(detail::ordered_sum(y - across.high, -across.low), {denominator.high, denominator.low + along.low});
    const double z = rest.high(), square = z * z, fourth = square * square;
    const double odd =
        (-1.0 / 3 + square * (1.0 / 5)) + fourth * ((-1.0 / 7 + square * (1.0 / 9)) - fourth * (1.0 / 11));
    return sum_of(arc_tangents()[i], DoubleDouble::exact_sum(z, rest.low() + z * (square * odd)));
}

/// The angle as a pair, with a relative error below 2^-60, or rounded where it is tiny.
DoubleDouble pair(double y, double x) {
    constexpr DoubleDouble zero;
    static const DoubleDouble straight_angle = DoubleDouble::exact_sum(0x1.921fb54442d18p+1, 0x1.1a62633145c07p-53);
    static const DoubleDouble right_angle = DoubleDouble::exact_sum(0x1.921fb54442d18p+0, 0x1.1a62633145c07p-54);
    const double height = std::abs(y), width = std::abs(x);
    const bool is_steep = height > width;
    const bool is_backward = std::signbit(x);
    const DoubleDouble angle = is_steep ? arc_tangent_to_one(width, height) : arc_tangent_to_one(height, width);
    const DoubleDouble& base = is_steep ? right_angle : is_backward ? straight_angle : zero;
    const DoubleDouble upper = sum_of(base, is_steep != is_backward ? -angle : angle);
    return std::signbit(y) ? -upper : upper;
}

} // namespace

double arc_tangent(double y, double x) {
    return pair(y, x).high();
}

/// The cosine is a rounded square root. The direction has the length one, so the angle is off by the sine times the
/// error.
double arc_sine(double sine) {
    const auto square = detail::exact_product(sine, sine);
    const auto rest = detail::exact_sum(1.0, -square.high);
    const double rest_low = rest.low - square.low;
    const double cosine = std::sqrt(rest.high + rest_low);
    const auto product = detail::exact_product(cosine, cosine);
    const double missing = rest.high - product.high + (rest_low - product.low);
    const DoubleDouble angle = pair(sine, cosine);
    return angle.high() + (angle.low() - (cosine > 0 ? sine * missing / (2 * cosine) : 0));
}

/// The angle in double is off by some 2^-52: its sine is the error up to 2^-158.
DoubleDouble angle_of(const SineCosine<DoubleDouble>& direction) {
    const DoubleDouble rough(arc_tangent(direction.sine.high(), direction.cosine.high()));
    const auto [sine, cosine] = sine_cosine(rough);
    return rough + (direction.sine * cosine - direction.cosine * sine);
}

} // namespace chasles::algebra
