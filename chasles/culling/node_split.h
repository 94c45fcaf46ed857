// How a traversal divides a pair of nodes, in space and in time.
// Source: docs/derivations/14-node-pairs.md.
#pragma once

#include "chasles/culling/pair_queue.h"

#include <algorithm>
#include <span>

namespace chasles::culling {

inline float longest_side(const BvhNode& node) {
    return std::max({node.upper[0] - node.lower[0], node.upper[1] - node.lower[1], node.upper[2] - node.lower[2]});
}

/// One node or two siblings.
struct NodeRange {
    std::uint32_t first;
    std::uint32_t count;

    [[nodiscard]] TwoNodes of(std::span<const BvhNode> nodes) const {
        return {&nodes[first], &nodes[first + count - 1]};
    }
};

/// The nodes whose pairs replace a pair. A pair splits both nodes, or only the much larger node.
struct NodeSplit {
    /// Both nodes split unless the side of one node is smaller than this fraction of the side of the other node.
    static constexpr float much_smaller = 0.5F;

    NodeRange moving;
    NodeRange fixed;

    /// At least one of the two nodes must not be a leaf.
    NodeSplit(const NodePair& pair, std::span<const BvhNode> moving_nodes, std::span<const BvhNode> fixed_nodes) {
        const BvhNode& a = moving_nodes[pair.moving];
        const BvhNode& b = fixed_nodes[pair.fixed];
        const float a_side = longest_side(a);
        const float b_side = longest_side(b);
        const bool a_splits = !a.is_leaf() && (b.is_leaf() || a_side >= much_smaller * b_side);
        const bool b_splits = !b.is_leaf() && (a.is_leaf() || b_side >= much_smaller * a_side);
        moving = a_splits ? NodeRange{a.first, 2} : NodeRange{pair.moving, 1};
        fixed = b_splits ? NodeRange{b.first, 2} : NodeRange{pair.fixed, 1};
    }
};

/// The window relative to the earlier or later half of the interval, cut off at the ends of the half. It is exact.
inline Window in_half(const Window& when, bool later) {
    const float offset = later ? 1 : 0;
    return {std::max(0.0F, 2 * when.lower - offset), std::min(1.0F, 2 * when.upper - offset)};
}

} // namespace chasles::culling
