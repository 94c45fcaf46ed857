#include "chasles/scene/pairs_by_distance.h"

#include "chasles/scene/curve_order.h"
#include "chasles/scene/pair_tasks.h"

#include <limits>
#include <numeric>

namespace chasles::scene {

SweptTree::SweptTree(const Scene& scene, const std::vector<std::size_t>& bodies) {
    std::vector<Box> boxes;
    std::vector<Eigen::Vector3d> middles;
    for (const std::size_t body : bodies) {
        require_body(scene, body);
        const WorldMotion& motion = scene.motion_of(body);
        boxes.push_back(swept({scene.bodies()[body].shape.body(), *motion.frame, motion.rests}, 1).box);
        middles.emplace_back(0.5 * boxes.back().min() + 0.5 * boxes.back().max());
    }
    levels_.emplace_back();
    for (const std::uint32_t i : curve_order(middles, 1)) {
        bodies_.push_back(bodies[i]);
        levels_[0].push_back(boxes[i]);
    }
    while (levels_.back().size() > 1)
        add_level();
}

void SweptTree::add_level() {
    const std::vector<Box>& below = levels_.back();
    std::vector<Box> level((below.size() + arity - 1) / arity);
    for (std::size_t i = 0; i < below.size(); ++i)
        level[i / arity].extend(below[i]);
    levels_.push_back(std::move(level));
}

PairLists all_pairs(const Scene& scene) {
    PairLists lists;
    lists.rests = false;
    lists.first.resize(scene.bodies().size());
    std::iota(lists.first.begin(), lists.first.end(), std::size_t{0});
    return lists;
}

PairsByDistance::PairsByDistance(const Scene& scene, const PairLists& lists)
    : scene_(scene), is_within_(!lists.second), rests_(lists.rests), first_(scene, lists.first),
      second_(scene, lists.second.value_or(std::vector<std::size_t>())) {
    if (!first_.is_empty() && !second().is_empty())
        push(first_.root(), second().root(), std::numeric_limits<double>::infinity());
}

/// The boxes hold their bodies, so their distance is a lower bound. Its own rounding is below 4 units in the last
/// place.
void PairsByDistance::push(const SweptTree::Node& first, const SweptTree::Node& second, double distance) {
    constexpr double rounding = 1e-14;
    const double bound = first_.box(first).exteriorDistance(this->second().box(second)) * (1 - rounding);
    if (bound < distance)
        queue_.push({bound, first, second});
}

/// Splits the higher node, or both. A node with itself gives each pair of children once.
void PairsByDistance::split(const NodePair& nodes, double distance) {
    using Node = SweptTree::Node;
    const Node &first = nodes.first, &second = nodes.second;
    if (is_within_ && first == second)
        first_.for_each_child(first, [&](const Node& a) {
            first_.for_each_child(first, [&](const Node& b) {
                if (a.index < b.index || (a.index == b.index && a.level > 0))
                    push(a, b, distance);
            });
        });
    else if (first.level > second.level)
        first_.for_each_child(first, [&](const Node& a) { push(a, second, distance); });
    else if (first.level < second.level)
        this->second().for_each_child(second, [&](const Node& b) { push(first, b, distance); });
    else
        first_.for_each_child(first, [&](const Node& a) {
            this->second().for_each_child(second, [&](const Node& b) { push(a, b, distance); });
        });
}

std::optional<PairsByDistance::Pair> PairsByDistance::pair_of(const NodePair& leaves) const {
    const std::size_t first = first_.body(leaves.first), other = second().body(leaves.second);
    const bool never_move = scene_.rests(first) && scene_.rests(other);
    if (first == other || scene_.is_ignored(first, other) || (never_move && !rests_))
        return std::nullopt;
    const IndexPair pair{std::uint32_t(first), std::uint32_t(other)};
    const auto [moving, fixed] = is_within_ ? in_their_roles(scene_, pair) : pair;
    return Pair{moving, fixed, leaves.bound};
}

std::optional<PairsByDistance::Pair> PairsByDistance::next(double distance) {
    while (!queue_.empty() && queue_.top().bound < distance) {
        const NodePair nodes = queue_.top();
        queue_.pop();
        if (nodes.first.level > 0 || nodes.second.level > 0)
            split(nodes, distance);
        else if (const std::optional<Pair> pair = pair_of(nodes))
            return pair;
    }
    return std::nullopt;
}

} // namespace chasles::scene
