#include "chasles/culling/time_tree.h"

#include <algorithm>
#include <cmath>

namespace chasles::culling {

namespace {

/// Boxes lose at most so much where subnormal floats are flushed to zero.
constexpr double flushed = 0x1p-110;
/// Roundings of single precision in a gap, of all lengths that enter: 90 are counted, and with a margin 165.
constexpr double float_rounding = 128 * 0x1p-24;
constexpr double float_rounding_with_margin = 192 * 0x1p-24;

} // namespace

TimeTree::TimeTree(const motion::ControlMaps<double>& whole, const motion::ChordDeviation& bend,
                   const motion::Ball& moving, const motion::Ball& fixed, const elementary::ErrorScale& scale,
                   double margin)
    : whole_(whole), bend_(bend), moving_(moving), fixed_(fixed), margin_(margin),
      rounding_(elementary::error_unit<double> * scale.length + flushed) {}

TimeInterval TimeTree::interval(const TimeRange& range) const {
    const Placement start = placement(range.lower);
    const Placement end = placement(range.upper);
    const double away = std::max(start.offset.lpNorm<1>(), end.offset.lpNorm<1>());
    const double unit = margin_ > 0 ? float_rounding_with_margin : float_rounding;
    const double rounding = rounding_ + unit * (moving_.radius + fixed_.radius + away);
    const double moving_bend = bend_.of_moving(range.lower, range.upper);
    const double fixed_bend = bend_.of_fixed(range.lower, range.upper);
    return {range, SweptBoxes(start, end, {moving_bend + rounding, fixed_bend + rounding, margin_}),
            std::max(moving_bend, fixed_bend), rounding};
}

Placement TimeTree::placement(double tau) const {
    const double weight = value_at(whole_.weight, tau);
    const auto value = [&](const algebra::Bernstein<3, double>& p) { return value_at(p, tau) / weight; };
    Placement placed;
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j)
            placed.turn(i, j) = value(whole_.rotation.row[i][j]);
        placed.offset[i] = value(whole_.translation[i]);
    }
    placed.offset += placed.turn * moving_.centre - fixed_.centre;
    return placed;
}

TimeRange part_around(const TimeRange& interval, const TimeRange& needed, double least) {
    int exponent = 0;
    std::frexp(std::max(least, needed.width()), &exponent);
    for (double width = std::ldexp(1.0, exponent); width < interval.width(); width *= 2) {
        const double grid = 0.25 * width;
        const double lower = std::clamp(std::floor(needed.lower / grid) * grid, interval.lower, interval.upper - width);
        if (lower + width >= needed.upper)
            return {lower, lower + width};
    }
    return interval;
}

} // namespace chasles::culling
