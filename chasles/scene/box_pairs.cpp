#include "chasles/scene/box_pairs.h"

#include "chasles/base/parallel_for.h"

#include <algorithm>
#include <array>
#include <numeric>

namespace chasles::scene {

namespace {

constexpr std::uint32_t most_of_leaf = 4;
/// Boxes of one piece of work.
constexpr std::size_t chunk = 256;

bool overlap(const Box& a, const Box& b) {
    return (a.min().array() <= b.max().array()).all() && (b.min().array() <= a.max().array()).all();
}

} // namespace

BoxTree::BoxTree(const std::vector<Box>& boxes) : boxes_(boxes), order_(boxes.size()) {
    std::iota(order_.begin(), order_.end(), 0U);
    nodes_.reserve(boxes.size());
    if (!boxes.empty())
        build(0, std::uint32_t(boxes.size()));
}

void BoxTree::build(std::uint32_t begin, std::uint32_t end) {
    Box box, centres;
    for (std::uint32_t place = begin; place < end; ++place) {
        box.extend(boxes_[order_[place]]);
        centres.extend(boxes_[order_[place]].center());
    }
    const std::size_t node = nodes_.size();
    nodes_.push_back({box, begin, end, 0});
    if (end - begin <= most_of_leaf)
        return;
    Eigen::Index axis = 0;
    centres.sizes().maxCoeff(&axis);
    const std::uint32_t middle = begin + (end - begin) / 2;
    const auto key = [&](std::uint32_t i) { return std::pair(boxes_[i].min()[axis] + boxes_[i].max()[axis], i); };
    std::ranges::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end, {}, key);
    build(begin, middle);
    nodes_[node].right = std::uint32_t(nodes_.size());
    build(middle, end);
}

/// With the boxes at later places.
void BoxTree::append_pairs_of(std::uint32_t place, std::vector<IndexPair>& pairs) const {
    constexpr std::size_t depth = 64; // medians halve 2^32 places
    std::array<std::uint32_t, depth>
        waiting; // NOLINT(cppcoreguidelines-pro-type-member-init): the first `count` are set
    std::size_t count = 0;
    const std::uint32_t own = order_[place];
    const Box& box = boxes_[own];
    waiting[count++] = 0;
    while (count > 0) {
        const std::uint32_t index = waiting[--count];
        const Node& node = nodes_[index];
        if (node.end <= place + 1 || !overlap(node.box, box))
            continue;
        if (node.right != 0) {
            waiting[count++] = node.right;
            waiting[count++] = index + 1;
            continue;
        }
        for (std::uint32_t other = std::max(node.begin, place + 1); other < node.end; ++other)
            if (overlap(boxes_[order_[other]], box))
                pairs.push_back(std::minmax(own, order_[other]));
    }
}

std::vector<IndexPair> BoxTree::overlapping_pairs(unsigned threads) const {
    const std::size_t count = boxes_.size();
    std::vector<std::vector<IndexPair>> chunks((count + chunk - 1) / chunk);
    parallel_chunks(threads, count, chunk, [&](std::size_t index, std::size_t begin, std::size_t end) {
        for (std::size_t place = begin; place < end; ++place)
            append_pairs_of(std::uint32_t(place), chunks[index]);
    });
    std::vector<IndexPair> pairs;
    for (const std::vector<IndexPair>& part : chunks)
        pairs.insert(pairs.end(), part.begin(), part.end());
    return pairs;
}

} // namespace chasles::scene
