// The intervals of tau that a traversal visits, with swept boxes for pairs of nodes.
// Source: docs/derivations/14-node-pairs.md.
#pragma once

#include "chasles/culling/piece_parts.h"
#include "chasles/culling/swept_boxes.h"
#include "chasles/motion/matrix_pose.h"

namespace chasles::culling {

/// The greatest loss of a box where subnormal floats are flushed to zero, in the length unit.
inline constexpr double flushed_floats = 0x1p-110;

/// A bound of the rounding error of a gap in single precision. `size` is the sum of all lengths. Note 14 counts 90
/// roundings, note 16 counts 165 with a margin.
inline double float_rounding(double size, double margin) {
    return (margin > 0 ? 192 * 0x1p-24 : 128 * 0x1p-24) * size;
}

/// A range with the data for node pairs. Its ends are multiples of a power of two.
struct TimeInterval {
    TimeRange range;
    SweptBoxes boxes;
    double deviation = 0; ///< the greatest chord deviation of both bodies, in the length unit
    double rounding = 0;  ///< the share of the widening that shorter intervals do not reduce, in the length unit
};

/// The intervals of one piece.
class TimeTree {
public:
    /// The maps of the piece are kept by reference. `chords` is for the whole piece; it has no effect if parts are
    /// enclosed. Points within `margin` of each other count as touching: both balls are larger by it.
    TimeTree(const PieceParts& parts, const motion::ChordDeviation& chords, const motion::Ball& moving,
             const motion::Ball& fixed, double margin = 0);

    [[nodiscard]] TimeInterval interval(const TimeRange& range) const;
    /// Whether parts of the motion are enclosed.
    [[nodiscard]] bool are_enclosed() const { return parts_.are_enclosed(); }

private:
    /// How far the points of either body leave their chords.
    struct Deviations {
        double moving;
        double fixed;
    };

    [[nodiscard]] TimeInterval enclosed_interval(const TimeRange& range) const;
    [[nodiscard]] TimeInterval interval_between(const TimeRange& range, const Placement& start, const Placement& end,
                                                const Deviations& deviations) const;
    [[nodiscard]] Placement placement(double tau) const;
    [[nodiscard]] Placement placement(const motion::MatrixPose& pose) const;

    PieceParts parts_;
    motion::ChordDeviation chords_;
    motion::Ball moving_;
    motion::Ball fixed_;
    double margin_;
    double rounding_; ///< rounding of positions in double precision
};

} // namespace chasles::culling
