// The ball around a body that its box hierarchy tells.
#pragma once

#include "chasles/hierarchy/bvh.h"
#include "chasles/motion/chord_deviation.h"

namespace chasles::culling {

/// Around the centre of the hierarchy, in the body's frame.
inline motion::Ball ball_around(const Bvh& hierarchy) {
    return {hierarchy.centre(), hierarchy.radius()};
}

} // namespace chasles::culling
