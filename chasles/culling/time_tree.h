// The intervals of tau that a traversal visits: swept boxes for pairs of nodes, and control maps for pairs of features.
// Source: docs/derivations/14-node-pairs.md.
#pragma once

#include "chasles/culling/swept_boxes.h"
#include "chasles/elementary/error_scale.h"
#include "chasles/motion/chord_deviation.h"

namespace chasles::culling {

/// The greatest loss of a box where subnormal floats are flushed to zero, in the length unit.
inline constexpr double flushed_floats = 0x1p-110;

/// A bound of the rounding error of a gap in single precision. `size` is the sum of all lengths. Note 14 counts 90
/// roundings, note 16 counts 165 with a margin.
inline double float_rounding(double size, double margin) {
    return (margin > 0 ? 192 * 0x1p-24 : 128 * 0x1p-24) * size;
}

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

/// A range with the data for node pairs. Its ends are multiples of a power of two.
struct TimeInterval {
    TimeRange range;
    SweptBoxes boxes;
    double deviation = 0; ///< the greatest chord deviation of both bodies, in the length unit
    double rounding = 0;  ///< the widening of the boxes for rounding, in the length unit
};

/// The intervals of one motion.
class TimeTree {
public:
    /// Keeps the maps by reference. Points within `margin` of each other count as touching.
    TimeTree(const motion::ControlMaps<double>& whole, const motion::ChordDeviation& deviation,
             const motion::Ball& moving, const motion::Ball& fixed, const elementary::ErrorScale& scale,
             double margin = 0);

    [[nodiscard]] TimeInterval interval(const TimeRange& range) const;

private:
    [[nodiscard]] Placement placement(double tau) const;

    const motion::ControlMaps<double>& whole_;
    motion::ChordDeviation deviation_;
    motion::Ball moving_;
    motion::Ball fixed_;
    double margin_;
    double rounding_; ///< rounding of positions in double precision
};

/// The control maps over the current range.
class RangeMaps {
public:
    /// Keeps the maps of the whole motion by reference.
    explicit RangeMaps(const motion::ControlMaps<double>& whole) : whole_(whole) {}

    /// Changes the range. Returns false if it is the current range. The maps are always restricted from the whole
    /// motion, therefore rounding errors do not accumulate.
    bool set(const TimeRange& range) {
        if (range == range_)
            return false;
        range_ = range;
        maps_ = range == TimeRange() ? whole_ : motion::restricted(whole_, range.lower, range.upper);
        return true;
    }
    [[nodiscard]] const motion::ControlMaps<double>& maps() const { return maps_; }

private:
    const motion::ControlMaps<double>& whole_;
    TimeRange range_{0, 0}; ///< empty before the first call of `set`
    motion::ControlMaps<double> maps_;
};

/// The least part of the interval that contains `needed`, has a power of two as width, and starts at a multiple of a
/// quarter of its width or at an end of the interval. Its width is at least `least`. If no part fits, the result is the
/// interval.
TimeRange part_around(const TimeRange& interval, const TimeRange& needed, double least = shortest_interval);

} // namespace chasles::culling
