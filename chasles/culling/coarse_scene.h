// Two bodies and the coarse motion between them, with a bound of how far true places are from computed ones.
// Source: docs/derivations/23-coarse-motion.md.
#pragma once

#include "chasles/culling/swept_boxes.h"
#include "chasles/mesh/body.h"
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
};

} // namespace chasles::culling
