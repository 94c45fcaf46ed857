// Evaluates the control maps at both ends of an interval and sums up by how much its boxes must be widened.
// Source: docs/derivations/14-node-pairs.md, "Rounding".
#include "chasles/culling/time_tree.h"

#include <algorithm>
#include <cmath>

namespace chasles::culling {

TimeTree::TimeTree(const motion::ControlMaps<double>& whole, const motion::ChordDeviation& deviation,
                   const motion::Ball& moving, const motion::Ball& fixed, const elementary::ErrorScale& scale,
                   double margin)
    : whole_(whole), deviation_(deviation), moving_(moving), fixed_(fixed), margin_(margin),
      rounding_(elementary::error_unit<double> * scale.length + flushed_floats) {}

/// Boxes are widened by the chord deviation and by all roundings, at both ends of the interval.
TimeInterval TimeTree::interval(const TimeRange& range) const {
    const Placement start = placement(range.lower);
    const Placement end = placement(range.upper);
    const double distance = std::max(start.offset.lpNorm<1>(), end.offset.lpNorm<1>());
    const double rounding = rounding_ + float_rounding(moving_.radius + fixed_.radius + distance, margin_);
    const double moving_deviation = deviation_.of_moving(range.lower, range.upper);
    const double fixed_deviation = deviation_.of_fixed(range.lower, range.upper);
    return {range, SweptBoxes(start, end, {moving_deviation + rounding, fixed_deviation + rounding, margin_}),
            std::max(moving_deviation, fixed_deviation), rounding};
}

Placement TimeTree::placement(double tau) const {
    const double weight = value_at(whole_.weight, tau);
    const auto value = [&](const algebra::Bernstein<3, double>& p) { return value_at(p, tau) / weight; };
    Placement placed;
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j)
            placed.rotation(i, j) = value(whole_.rotation.row[i][j]);
        placed.offset[i] = value(whole_.translation[i]);
    }
    placed.offset += placed.rotation * moving_.centre - fixed_.centre;
    return placed;
}

TimeRange part_around(const TimeRange& interval, const TimeRange& needed, double least) {
    int exponent = 0;
    std::frexp(std::max(least, needed.width()), &exponent);
    double width = std::ldexp(1.0, exponent);
    while (width < interval.width()) {
        const double grid = 0.25 * width;
        const double lower = std::clamp(std::floor(needed.lower / grid) * grid, interval.lower, interval.upper - width);
        if (lower + width >= needed.upper)
            return {lower, lower + width};
        width *= 2;
    }
    return interval;
}

} // namespace chasles::culling
