// The ball around a body that its box hierarchy tells.
#pragma once

#include "chasles/mesh/box_hierarchy.h"
#include "chasles/motion/path_bend.h"

namespace chasles::query {

/// Around the centre of the hierarchy, in the body's frame.
inline motion::Ball ball_around(const BoxHierarchy& hierarchy) {
    const BoxNode& root = hierarchy.nodes()[0];
    Eigen::Vector3d reach;
    for (int i = 0; i < 3; ++i)
        reach[i] = std::max(std::abs(double(root.lower[i])), std::abs(double(root.upper[i])));
    return {hierarchy.centre(), reach.norm() * (1 + 1e-14)};
}

} // namespace chasles::query
