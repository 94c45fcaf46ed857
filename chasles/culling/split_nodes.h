// Which nodes a pair of nodes is split into: one rule for all traversals.
#pragma once

#include "chasles/culling/swept_boxes.h"

#include <span>

namespace chasles::culling {

/// One node or two siblings.
struct NodeRange {
    std::uint32_t first;
    std::uint32_t count;

    [[nodiscard]] TwoNodes of(std::span<const BvhNode> nodes) const {
        return {&nodes[first], &nodes[first + count - 1]};
    }
};

/// The children of a node, or the node itself: if it is a leaf, or if its side is shorter than half of the side of the
/// other node, which then splits alone.
inline NodeRange split_against(std::span<const BvhNode> nodes, std::uint32_t node, const BvhNode& other) {
    constexpr float much_smaller = 0.5F;
    const BvhNode& own = nodes[node];
    const bool splits = !own.is_leaf() && (other.is_leaf() || longest_side(own) >= much_smaller * longest_side(other));
    return splits ? NodeRange{own.first, 2} : NodeRange{node, 1};
}

} // namespace chasles::culling
