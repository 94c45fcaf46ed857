// Parts of the parameter of a piece.
#pragma once

namespace chasles::culling {

/// The traversal halves no interval of this width or less, in tau.
inline constexpr double shortest_interval = 0x1p-40;

/// A part of [0, 1] in tau.
struct TimeRange {
    double lower = 0;
    double upper = 1;

    [[nodiscard]] double width() const { return upper - lower; }
    [[nodiscard]] double at(double share) const { return lower + share * width(); }
    friend bool operator==(const TimeRange&, const TimeRange&) = default;
};

/// The least part of the interval that contains `needed`, has a power of two as width, and starts at a multiple of a
/// quarter of its width or at an end of the interval. Its width is at least `least`. If no part fits, the result is the
/// interval.
TimeRange part_around(const TimeRange& interval, const TimeRange& needed, double least = shortest_interval);

} // namespace chasles::culling
