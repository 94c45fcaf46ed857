#include "chasles/scene/box_pairs.h"

#include "chasles/base/parallel_for.h"
#include "chasles/base/sort.h"
#include "chasles/scene/curve_order.h"

#include <algorithm>
#include <bit>

namespace chasles::scene {

namespace {

constexpr std::size_t width = BoxBlock::size;
/// Blocks that one thread takes at a time.
constexpr std::size_t chunk = 16;

std::size_t blocks_for(std::size_t boxes) {
    return (boxes + width - 1) / width;
}

/// Calls work(i) for each bit i that is set.
template <class Work>
void for_each_bit(unsigned bits, const Work& work) {
    for (; bits != 0; bits &= bits - 1)
        work(std::size_t(std::countr_zero(bits)));
}

std::vector<Eigen::Vector3d> middles_of(const std::vector<SweptBody>& bodies, unsigned threads) {
    std::vector<Eigen::Vector3d> middles(bodies.size());
    parallel_chunks(threads, bodies.size(), width * chunk, [&](std::size_t, std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            middles[i] = 0.5 * bodies[i].box.min() + 0.5 * bodies[i].box.max();
    });
    return middles;
}

} // namespace

/// There is a level above that of the boxes, however few they are.
BoxTree::BoxTree(const std::vector<SweptBody>& bodies, unsigned threads)
    : order_(curve_order(middles_of(bodies, threads), threads)), places_(bodies.size()) {
    for (std::uint32_t place = 0; place < order_.size(); ++place)
        places_[order_[place]] = place;
    Level boxes(blocks_for(order_.size()));
    parallel_chunks(threads, boxes.size(), chunk, [&](std::size_t, std::size_t begin, std::size_t end) {
        for (std::size_t place = begin * width; place < std::min(end * width, order_.size()); ++place)
            boxes[place / width].set(place % width, rounded(bodies[order_[place]].box));
    });
    levels_.push_back(std::move(boxes));
    do
        add_level(threads);
    while (levels_.back().size() > 1);
}

void BoxTree::add_level(unsigned threads) {
    const Level& below = levels_.back();
    Level level(blocks_for(below.size()));
    parallel_chunks(threads, level.size(), chunk, [&](std::size_t, std::size_t begin, std::size_t end) {
        for (std::size_t block = begin * width; block < std::min(end * width, below.size()); ++block)
            level[block / width].set(block % width, below[block].hull());
    });
    levels_.push_back(std::move(level));
}

template <bool is_for_boxes, class Report>
void BoxTree::visit(std::size_t level, std::size_t block, const FloatBox& box, const Report& report) const {
    constexpr std::size_t last = is_for_boxes ? 0 : 1;
    for_each_bit(levels_[level][block].overlapping(box), [&](std::size_t i) {
        if (level == last)
            report(block * width + i);
        else
            visit<is_for_boxes>(level - 1, block * width + i, box, report);
    });
}

void BoxTree::append_pairs_of_blocks(std::size_t first, std::size_t second, std::vector<IndexPair>& pairs) const {
    const BoxBlock& a = levels_[0][first];
    const BoxBlock& b = levels_[0][second];
    for_each_bit(a.overlapping(hull_of(second)), [&](std::size_t i) {
        const unsigned later = first == second ? ~1U << i : ~0U; // a pair in one block appears once
        for_each_bit(b.overlapping(a[i]) & later, [&](std::size_t j) {
            pairs.emplace_back(std::minmax(order_[first * width + i], order_[second * width + j]));
        });
    });
}

/// The pairs of a block with itself and with later blocks.
void BoxTree::append_pairs(std::size_t first, std::vector<IndexPair>& pairs) const {
    visit<false>(levels_.size() - 1, 0, hull_of(first), [&](std::size_t second) {
        if (second >= first)
            append_pairs_of_blocks(first, second, pairs);
    });
}

std::vector<IndexPair> BoxTree::overlapping_pairs(unsigned threads) const {
    return joined_chunks<IndexPair>(threads, levels_[0].size(), chunk,
                                    [&](std::size_t begin, std::size_t end, std::vector<IndexPair>& pairs) {
                                        for (std::size_t block = begin; block < end; ++block)
                                            append_pairs(block, pairs);
                                    });
}

std::vector<std::uint32_t> BoxTree::overlapping(const Box& box) const {
    std::vector<std::uint32_t> found;
    if (!order_.empty())
        visit<true>(levels_.size() - 1, 0, rounded(box), [&](std::size_t place) { found.push_back(order_[place]); });
    chasles::sort(found);
    return found;
}

void BoxTree::replace(std::uint32_t index, const Box& box) {
    std::size_t place = places_[index];
    levels_[0][place / width].set(place % width, rounded(box));
    for (std::size_t level = 1; level < levels_.size(); ++level) {
        const FloatBox hull = levels_[level - 1][place / width].hull();
        place /= width;
        levels_[level][place / width].set(place % width, hull);
    }
}

} // namespace chasles::scene
