// The intervals of tau that a traversal visits: for hierarchies, the bodies at both ends; for features, control maps.
// Source: docs/derivations/14-node-pairs.md.
#pragma once

#include "chasles/culling/swept_boxes.h"
#include "chasles/elementary/error_scale.h"
#include "chasles/motion/chord_deviation.h"

namespace chasles::culling {

/// As short as the tolerance of the answer: not halved.
inline constexpr double shortest_interval = 0x1p-40;

/// A part of [0, 1].
struct TimeRange {
    double lower = 0;
    double upper = 1;

    [[nodiscard]] double width() const { return upper - lower; }
    [[nodiscard]] double at(double share) const { return lower + share * width(); }
    friend bool operator==(const TimeRange&, const TimeRange&) = default;
};

/// A dyadic interval.
struct TimeInterval {
    TimeRange range;
    SweptBoxes boxes;
    double bend = 0;     ///< how far paths leave their chords, at most
    double rounding = 0; ///< what boxes are widened by besides
};

/// Makes intervals of one motion.
class TimeTree {
public:
    /// Maps are kept by reference. Points within `margin` of each other count as meeting.
    TimeTree(const motion::ControlMaps<double>& whole, const motion::ChordDeviation& bend, const motion::Ball& moving,
             const motion::Ball& fixed, const elementary::ErrorScale& scale, double margin = 0);

    [[nodiscard]] TimeInterval interval(const TimeRange& range) const;

private:
    [[nodiscard]] Placement placement(double tau) const;

    const motion::ControlMaps<double>& whole_;
    motion::ChordDeviation bend_;
    motion::Ball moving_;
    motion::Ball fixed_;
    double margin_;
    double rounding_; ///< of positions in double precision
};

/// Control maps over one range at a time.
class RangeMaps {
public:
    /// Those of the whole motion are kept by reference.
    explicit RangeMaps(const motion::ControlMaps<double>& whole) : whole_(whole) {}

    /// False if the range is the one at hand. Maps are restricted from the whole, so that rounding does not build up.
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
    TimeRange range_{0, 0}; ///< none at first
    motion::ControlMaps<double> maps_;
};

/// The least part of the interval that is as wide as a power of two, begins at a multiple of a quarter of its width,
/// and holds `needed`; not narrower than `least`.
TimeRange part_around(const TimeRange& interval, const TimeRange& needed, double least = shortest_interval);

} // namespace chasles::culling
