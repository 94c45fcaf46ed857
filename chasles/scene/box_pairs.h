// Which boxes overlap? A tree over the boxes, tested against itself. Source: docs/derivations/27-scenes.md, "Pairs".
#pragma once

#include "chasles/scene/swept_body.h"

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace chasles::scene {

using IndexPair = std::pair<std::uint32_t, std::uint32_t>;

/// A tree of boxes, halved at the median of the longest side.
class BoxTree {
public:
    explicit BoxTree(const std::vector<SweptBody>& bodies);

    /// All pairs of boxes that overlap, each once, the smaller index first. They are in no useful order, but in the
    /// same one for any number of threads.
    [[nodiscard]] std::vector<IndexPair> overlapping_pairs(unsigned threads) const;
    /// The boxes that overlap with this one, in ascending order.
    [[nodiscard]] std::vector<std::uint32_t> overlapping(const Box& box) const;
    /// Gives the box with this index another place. The tree gets no better by it.
    void replace(std::uint32_t index, const Box& box);

private:
    struct Centre;
    struct Item {
        Box box;
        std::uint32_t index;
    };
    struct Node {
        Box box;
        std::uint32_t begin; ///< of the items below the node
        std::uint32_t end;
        std::uint32_t right; ///< the second child; the first one follows the node. 0 for a leaf
    };
    using NodePair = std::pair<std::uint32_t, std::uint32_t>;

    void build(const std::vector<SweptBody>& bodies, std::span<Centre> centres);
    void add_items(const std::vector<SweptBody>& bodies, std::span<const Centre> centres, Node& leaf);
    [[nodiscard]] std::vector<NodePair> tasks() const;
    [[nodiscard]] bool are_leaves(const NodePair& pair) const;
    void append_parts(const NodePair& pair, std::vector<NodePair>& parts) const;
    void append_pairs(const NodePair& pair, std::vector<IndexPair>& pairs) const;
    void append_pairs_of_leaves(const Node& a, const Node& b, std::vector<IndexPair>& pairs) const;

    std::vector<Item> items_;
    std::vector<std::uint32_t> places_; ///< of each index in items_
    std::vector<Node> nodes_;
};

} // namespace chasles::scene
