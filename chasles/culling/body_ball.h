// A ball that encloses a body, taken from its BVH.
// The far-apart test and the chord deviation use it.
#pragma once

#include "chasles/hierarchy/bvh.h"
#include "chasles/motion/chord_deviation.h"

namespace chasles::culling {

/// The ball around the centre of the hierarchy, larger by `more`, in the body's frame and length unit.
inline motion::Ball ball_around(const Bvh& hierarchy, double more = 0) {
    return {hierarchy.centre(), hierarchy.radius() + more};
}

} // namespace chasles::culling
