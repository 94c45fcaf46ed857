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

/// What takes the place of a pair of nodes.
struct SplitPair {
    NodeRange moving;
    NodeRange fixed;
};

/// The children of both nodes. A leaf stays itself, and so does a node whose side is shorter than half of the side of
/// the other node, if that one has children.
inline SplitPair split_nodes(std::span<const BvhNode> moving_nodes, std::uint32_t moving_node,
                             std::span<const BvhNode> fixed_nodes, std::uint32_t fixed_node) {
    constexpr float much_smaller = 0.5F;
    const BvhNode& moving = moving_nodes[moving_node];
    const BvhNode& fixed = fixed_nodes[fixed_node];
    const float moving_side = longest_side(moving);
    const float fixed_side = longest_side(fixed);
    const bool moving_splits = !moving.is_leaf() && (fixed.is_leaf() || moving_side >= much_smaller * fixed_side);
    const bool fixed_splits = !fixed.is_leaf() && (moving.is_leaf() || fixed_side >= much_smaller * moving_side);
    return {moving_splits ? NodeRange{moving.first, 2} : NodeRange{moving_node, 1},
            fixed_splits ? NodeRange{fixed.first, 2} : NodeRange{fixed_node, 1}};
}

} // namespace chasles::culling
