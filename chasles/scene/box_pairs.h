// Which boxes overlap? A tree over the boxes, tested against itself. Source: docs/derivations/27-scenes.md, "Pairs".
#pragma once

#include "chasles/scene/box_block.h"

#include <cstdint>
#include <utility>
#include <vector>

namespace chasles::scene {

using IndexPair = std::pair<std::uint32_t, std::uint32_t>;

/// A tree of boxes with eight children a node. The boxes lie along a curve that fills space; eight that follow each
/// other are a node. All boxes are rounded to single precision, so boxes that barely miss each other may count as
/// overlapping.
class BoxTree {
public:
    explicit BoxTree(const std::vector<SweptBody>& bodies, unsigned threads = 1);

    /// All pairs of boxes that overlap, each once, the smaller index first. They are in no useful order, but in the
    /// same one for any number of threads.
    [[nodiscard]] std::vector<IndexPair> overlapping_pairs(unsigned threads) const;
    /// The boxes that overlap with this one, in ascending order.
    [[nodiscard]] std::vector<std::uint32_t> overlapping(const Box& box) const;
    /// Gives the box with this index another place. The tree gets no better by it.
    void replace(std::uint32_t index, const Box& box);

private:
    using Level = std::vector<BoxBlock>;

    void add_level(unsigned threads);
    /// The box around a block of boxes.
    [[nodiscard]] FloatBox hull_of(std::size_t block) const {
        return levels_[1][block / BoxBlock::size][block % BoxBlock::size];
    }
    /// Calls report(i) for the blocks i of the lowest level, or for the boxes i, that overlap with a box.
    template <bool is_for_boxes, class Report>
    void visit(std::size_t level, std::size_t block, const FloatBox& box, const Report& report) const;
    void append_pairs(std::size_t first, std::vector<IndexPair>& pairs) const;
    void append_pairs_of_blocks(std::size_t first, std::size_t second, std::vector<IndexPair>& pairs) const;

    std::vector<std::uint32_t> order_;  ///< the index of each box along the curve
    std::vector<std::uint32_t> places_; ///< of each index along the curve
    std::vector<Level> levels_;         ///< the first one holds the boxes, each other one those around the blocks below
};

} // namespace chasles::scene
