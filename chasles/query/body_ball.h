// The ball around a body that its box hierarchy tells.
#pragma once

#include "chasles/mesh/box_hierarchy.h"
#include "chasles/motion/path_bend.h"

namespace chasles::query {

/// Around the centre of the hierarchy, in the body's frame.
inline motion::Ball ball_around(const BoxHierarchy& hierarchy) {
    return {hierarchy.centre(), hierarchy.radius()};
}

} // namespace chasles::query
