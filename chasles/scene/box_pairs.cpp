#include "chasles/scene/box_pairs.h"

#include "chasles/base/parallel_for.h"
#include "chasles/base/sort.h"

#include <algorithm>

namespace chasles::scene {

namespace {

constexpr std::size_t most_of_leaf = 8;
/// Pairs of nodes that threads share.
constexpr std::size_t most_tasks = 512;

/// Without branches: whether boxes overlap cannot be foretold.
bool overlap(const Box& a, const Box& b) {
    const auto along = [&](Eigen::Index axis) {
        return int(a.min()[axis] <= b.max()[axis]) & int(b.min()[axis] <= a.max()[axis]);
    };
    return (along(0) & along(1) & along(2)) != 0;
}

} // namespace

/// What the median is taken of.
struct BoxTree::Centre {
    Eigen::Array3d twice;
    std::uint32_t index;
};

BoxTree::BoxTree(const std::vector<SweptBody>& bodies) {
    std::vector<Centre> centres;
    centres.reserve(bodies.size());
    for (const SweptBody& body : bodies)
        centres.push_back({body.box.min() + body.box.max(), std::uint32_t(centres.size())});
    nodes_.reserve(bodies.size());
    items_.reserve(bodies.size());
    places_.resize(bodies.size());
    if (!bodies.empty())
        build(bodies, centres);
}

void BoxTree::build(const std::vector<SweptBody>& bodies, std::span<Centre> centres) {
    const std::size_t node = nodes_.size();
    const auto begin = std::uint32_t(items_.size());
    nodes_.push_back({{}, begin, begin + std::uint32_t(centres.size()), 0});
    if (centres.size() <= most_of_leaf)
        return add_items(bodies, centres, nodes_.back());
    Eigen::Array3d least = centres.front().twice, greatest = least;
    for (const Centre& centre : centres) {
        least = least.min(centre.twice);
        greatest = greatest.max(centre.twice);
    }
    Eigen::Index axis = 0;
    (greatest - least).maxCoeff(&axis);
    const std::size_t middle = centres.size() / 2;
    std::ranges::nth_element(centres, centres.begin() + std::ptrdiff_t(middle), [axis](const auto& a, const auto& b) {
        return a.twice[axis] < b.twice[axis] || (a.twice[axis] == b.twice[axis] && a.index < b.index);
    });
    build(bodies, centres.first(middle));
    nodes_[node].right = std::uint32_t(nodes_.size());
    build(bodies, centres.subspan(middle));
    nodes_[node].box = nodes_[node + 1].box.merged(nodes_[nodes_[node].right].box);
}

void BoxTree::add_items(const std::vector<SweptBody>& bodies, std::span<const Centre> centres, Node& leaf) {
    for (const Centre& centre : centres) {
        places_[centre.index] = std::uint32_t(items_.size());
        items_.push_back({bodies[centre.index].box, centre.index});
        leaf.box.extend(items_.back().box);
    }
}

/// Or one leaf twice.
bool BoxTree::are_leaves(const NodePair& pair) const {
    return nodes_[pair.first].right == 0 && nodes_[pair.second].right == 0;
}

/// The pairs of nodes below a pair that are no leaves. A node against itself holds the pairs of all boxes below it.
void BoxTree::append_parts(const NodePair& pair, std::vector<NodePair>& parts) const {
    const auto [a, b] = pair;
    const auto append = [&](std::uint32_t x, std::uint32_t y) {
        if (x == y || overlap(nodes_[x].box, nodes_[y].box))
            parts.emplace_back(x, y);
    };
    const auto size = [&](std::uint32_t node) { return nodes_[node].end - nodes_[node].begin; };
    const std::uint32_t larger = size(a) < size(b) ? b : a;
    const std::uint32_t left = larger + 1, right = nodes_[larger].right;
    if (a == b) {
        append(left, left);
        append(right, right);
        append(left, right);
    } else {
        append(left, larger == a ? b : a);
        append(right, larger == a ? b : a);
    }
}

/// Pairs of nodes that together hold all pairs of boxes that overlap.
std::vector<BoxTree::NodePair> BoxTree::tasks() const {
    std::vector<NodePair> tasks;
    if (!nodes_.empty())
        tasks.emplace_back(0, 0);
    for (bool is_final = tasks.empty(); !is_final && tasks.size() < most_tasks;) {
        std::vector<NodePair> parts;
        is_final = true;
        for (const NodePair& pair : tasks)
            if (are_leaves(pair))
                parts.push_back(pair);
            else {
                append_parts(pair, parts);
                is_final = false;
            }
        tasks = std::move(parts);
    }
    return tasks;
}

void BoxTree::append_pairs_of_leaves(const Node& a, const Node& b, std::vector<IndexPair>& pairs) const {
    for (std::uint32_t i = a.begin; i < a.end; ++i)
        for (std::uint32_t j = &a == &b ? i + 1 : b.begin; j < b.end; ++j)
            if (overlap(items_[i].box, items_[j].box))
                pairs.emplace_back(std::minmax(items_[i].index, items_[j].index));
}

void BoxTree::append_pairs(const NodePair& pair, std::vector<IndexPair>& pairs) const {
    std::vector<NodePair> waiting{pair};
    while (!waiting.empty()) {
        const NodePair next = waiting.back();
        waiting.pop_back();
        if (are_leaves(next))
            append_pairs_of_leaves(nodes_[next.first], nodes_[next.second], pairs);
        else
            append_parts(next, waiting);
    }
}

std::vector<IndexPair> BoxTree::overlapping_pairs(unsigned threads) const {
    const std::vector<NodePair> shared = tasks();
    return joined_chunks<IndexPair>(threads, shared.size(), 1, [&](std::size_t task, std::size_t, auto& pairs) {
        append_pairs(shared[task], pairs);
    });
}

std::vector<std::uint32_t> BoxTree::overlapping(const Box& box) const {
    std::vector<std::uint32_t> found;
    std::vector<std::uint32_t> waiting(nodes_.empty() ? 0 : 1, 0);
    while (!waiting.empty()) {
        const std::uint32_t index = waiting.back();
        const Node& node = nodes_[index];
        waiting.pop_back();
        if (!overlap(node.box, box))
            continue;
        if (node.right != 0) {
            waiting.push_back(node.right);
            waiting.push_back(index + 1);
            continue;
        }
        for (std::uint32_t place = node.begin; place < node.end; ++place)
            if (overlap(items_[place].box, box))
                found.push_back(items_[place].index);
    }
    chasles::sort(found);
    return found;
}

void BoxTree::replace(std::uint32_t index, const Box& box) {
    const std::uint32_t place = places_[index];
    items_[place].box = box;
    std::uint32_t node = 0;
    for (;;) {
        nodes_[node].box.extend(box);
        const std::uint32_t right = nodes_[node].right;
        if (right == 0)
            return;
        node = place < nodes_[right].begin ? node + 1 : right;
    }
}

} // namespace chasles::scene
