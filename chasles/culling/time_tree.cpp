// Evaluates the placements at both ends of an interval and sums up by how much its boxes must be widened.
// Source: docs/derivations/14-node-pairs.md, "Rounding"; docs/derivations/24-enclosures.md, "Nodes".
#include "chasles/culling/time_tree.h"

#include "chasles/motion/coarse_motion.h"
#include "chasles/motion/screw_path.h"

#include <algorithm>

namespace chasles::culling {

TimeTree::TimeTree(const PieceParts& parts, const motion::ChordDeviation& chords, const motion::Ball& moving,
                   const motion::Ball& fixed, double margin)
    : parts_(parts), chords_(chords), moving_(moving), fixed_(fixed), margin_(margin),
      rounding_(elementary::error_unit<double> * parts.scale().length + flushed_floats) {}

TimeInterval TimeTree::interval(const TimeRange& range) const {
    if (parts_.are_enclosed())
        return enclosed_interval(range);
    return interval_between(range, placement(range.lower), placement(range.upper),
                            {chords_.of_moving(range.lower, range.upper), chords_.of_fixed(range.lower, range.upper)});
}

/// The true paths are as far from their chords as those of the cubic motion and the distance between both motions.
/// Points that truly touch may be apart by the deviation on the cubic motion, so the balls are larger by it.
TimeInterval TimeTree::enclosed_interval(const TimeRange& range) const {
    const motion::Enclosure<double> part = parts_.enclosure(range);
    const double deviation = parts_.deviation_of(part.bounds);
    const double rounding = parts_.rounding_of(part.bounds);
    const double from_chord = deviation + rounding;
    const motion::ChordDeviation chords(part.cubic, {moving_.centre, moving_.radius + deviation},
                                        {fixed_.centre, fixed_.radius + deviation});
    TimeInterval interval =
        interval_between(range, placement(position_at(part.cubic, 0)), placement(position_at(part.cubic, 1)),
                         {chords.of_moving(0, 1) + from_chord, chords.of_fixed(0, 1) + from_chord});
    interval.rounding += 3 * rounding; // twice of it is in the deviation of shorter intervals, too
    return interval;
}

/// Boxes are widened by the chord deviation and by all roundings, at both ends of the interval.
TimeInterval TimeTree::interval_between(const TimeRange& range, const Placement& start, const Placement& end,
                                        const Deviations& deviations) const {
    const double distance = std::max(start.offset.lpNorm<1>(), end.offset.lpNorm<1>());
    const double rounding = rounding_ + float_rounding(moving_.radius + fixed_.radius + distance, margin_);
    return {range, SweptBoxes(start, end, {deviations.moving + rounding, deviations.fixed + rounding, margin_}),
            std::max(deviations.moving, deviations.fixed), rounding};
}

Placement TimeTree::placement(double tau) const {
    const motion::ControlMaps<double>& whole = parts_.whole();
    const double weight = value_at(whole.weight, tau);
    const auto value = [&](const algebra::Bernstein<3, double>& p) { return value_at(p, tau) / weight; };
    Placement placed;
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j)
            placed.rotation(i, j) = value(whole.rotation.row[i][j]);
        placed.offset[i] = value(whole.translation[i]);
    }
    placed.offset += placed.rotation * moving_.centre - fixed_.centre;
    return placed;
}

Placement TimeTree::placement(const motion::MatrixPose& pose) const {
    Placement placed;
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j)
            placed.rotation(i, j) = pose.rotation.row[i][j];
        placed.offset[i] = pose.translation[i];
    }
    placed.offset += placed.rotation * moving_.centre - fixed_.centre;
    return placed;
}

} // namespace chasles::culling
