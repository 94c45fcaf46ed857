// Which boxes overlap? A tree over the boxes, visited by all of them. Source: docs/derivations/27-scenes.md, "Pairs".
#pragma once

#include "chasles/scene/world_box.h"

#include <cstdint>
#include <utility>
#include <vector>

namespace chasles::scene {

using IndexPair = std::pair<std::uint32_t, std::uint32_t>;

/// A tree of boxes, halved at the median of the longest side.
class BoxTree {
public:
    /// Keeps the boxes by reference.
    explicit BoxTree(const std::vector<Box>& boxes);

    /// All pairs of boxes that overlap, each once, the smaller index first, in no useful order that does not depend on
    /// the number of threads.
    [[nodiscard]] std::vector<IndexPair> overlapping_pairs(unsigned threads) const;

private:
    struct Node {
        Box box;
        std::uint32_t begin; ///< of the places in order_ below the node
        std::uint32_t end;
        std::uint32_t right; ///< the second child; the first one follows the node. 0 for a leaf
    };

    void build(std::uint32_t begin, std::uint32_t end);
    void append_pairs_of(std::uint32_t place, std::vector<IndexPair>& pairs) const;

    const std::vector<Box>& boxes_;
    std::vector<std::uint32_t> order_;
    std::vector<Node> nodes_;
};

} // namespace chasles::scene
