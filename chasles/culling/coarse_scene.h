// Two bodies and the coarse motion between them, with a bound of how far true places are from computed ones.
// Source: docs/derivations/23-coarse-motion.md.
#pragma once

#include "chasles/culling/swept_boxes.h"
#include "chasles/culling/time_range.h"
#include "chasles/mesh/body.h"
#include "chasles/motion/chord_deviation.h"
#include "chasles/motion/coarse_motion.h"

namespace chasles::culling {

/// All members are kept by reference.
struct CoarseScene {
    const Body& moving;
    const Body& fixed;
    const motion::CoarseMotion& motion;
    double margin;

    [[nodiscard]] Placement placement(double tau) const;
    /// A bound of the distance between the true place of a point and its computed place.
    [[nodiscard]] double deviation() const;
    /// Likewise at the start.
    [[nodiscard]] double start_deviation() const;

private:
    [[nodiscard]] double deviation_of(double reference, double turn) const;
};

/// How far true places leave the chords of the coarse motion.
class CoarseBounds {
public:
    explicit CoarseBounds(const CoarseScene& scene);

    /// The chord deviation in a part, the deviation of the coarse motion, and all roundings to single precision.
    [[nodiscard]] BoxSlack slack(const TimeRange& part, const Placement& start, const Placement& end) const;

private:
    double margin_;
    double deviation_;
    motion::Ball moving_; ///< enlarged: true contacts are within the margin and the deviation on the coarse motion
    motion::Ball fixed_;
    motion::ChordDeviation chords_;
};

} // namespace chasles::culling
