// How low the boxes and the faces below a node of a hierarchy go along a direction.
// Source: docs/derivations/39-profile.md, "The bounds of a part".
#pragma once

#include "chasles/culling/cached_face.h"
#include "chasles/mesh/body.h"

#include <algorithm>
#include <limits>
#include <span>
#include <vector>

namespace chasles::culling {

/// The least height of a box, from the centre of its hierarchy.
inline double lowest(const BvhNode& node, const algebra::Vector3<double>& n) {
    return std::min(n.x * node.lower[0], n.x * node.upper[0]) + std::min(n.y * node.lower[1], n.y * node.upper[1]) +
           std::min(n.z * node.lower[2], n.z * node.upper[2]);
}

/// The least height of the corners of the faces below a node, from the centre of the hierarchy. `nodes` is storage that
/// is reused.
inline double least_height(const Body& body, std::uint32_t node, const algebra::Vector3<double>& along,
                           std::vector<std::uint32_t>& nodes) {
    const std::span<const BvhNode> all = body.bvh().nodes();
    const auto centre = motion::vector_in<double>(body.bvh().centre());
    double least = std::numeric_limits<double>::infinity();
    nodes.assign(1, node);
    while (!nodes.empty()) {
        const BvhNode& next = all[nodes.back()];
        nodes.pop_back();
        if (lowest(next, along) >= least)
            continue;
        if (next.is_leaf()) {
            for (const std::uint32_t corner : body.face(next.first))
                least = std::min(least, dot(along, point_of<double>(body, corner) - centre));
            continue;
        }
        const bool second_is_lower = lowest(all[next.first + 1], along) < lowest(all[next.first], along);
        nodes.push_back(next.first + (second_is_lower ? 0 : 1));
        nodes.push_back(next.first + (second_is_lower ? 1 : 0));
    }
    return least;
}

} // namespace chasles::culling
