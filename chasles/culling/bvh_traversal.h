// The walk through both hierarchies in space and time: which pairs of faces may meet, and when. What is asked of them
// is the affair of its leaves. Source: docs/derivations/07-swept-boxes.md and 14-node-pairs.md.
#pragma once

#include "chasles/culling/pair_queue.h"
#include "chasles/culling/time_tree.h"

#include <algorithm>
#include <array>
#include <span>
#include <vector>

namespace chasles::culling {

/// Two faces that may meet in a part of an interval.
struct FacePair {
    std::uint32_t moving;
    std::uint32_t fixed;
    TimeRange interval;
    Window when;
    double first_left; ///< the earliest time of what is still to be visited in the interval
};

/// What a walk asks its leaves.
template <class T>
concept LeafTests = requires(T leaves, const FacePair& faces, const NodePair& nodes, double tau) {
    { leaves.best() } -> std::convertible_to<double>;           // nothing after it matters
    { leaves.is_over() } -> std::same_as<bool>;                 // nothing at all does any more
    { leaves.is_kept_apart(nodes, tau) } -> std::same_as<bool>; // told otherwise, from tau on
    leaves.test(faces);
};

/// One walk; `run` is called once.
template <LeafTests Leaves>
class BvhTraversal {
public:
    /// All are kept by reference. `by_time`: what may meet earlier comes first. `margin` is what counts as meeting.
    BvhTraversal(const Bvh& moving, const Bvh& fixed, const TimeTree& times, double margin, bool by_time,
                 Leaves& leaves)
        : moving_nodes_(moving.nodes()), fixed_nodes_(fixed.nodes()), times_(times), margin_(margin), queue_(by_time),
          leaves_(leaves) {}

    /// Answers how many pairs of nodes were asked about.
    std::uint64_t run() {
        queue_.push({0, 0, {}}); // the roots, which may well meet
        search_interval({});
        return node_pairs_;
    }

private:
    /// Intervals are halved for boxes of which the paths bend by more than these parts of their size and the margin.
    /// Measured on the cases of peers_bench: 0.05 takes twice the time for long turns of large meshes and saves a tenth
    /// on short motions. On those of margin_bench: without the margin, up to half as long again for a tenth of a body;
    /// with three times as much of it, more than four times as long.
    static constexpr double bend_of_size = 0.01;
    static constexpr double bend_of_margin = 0.001;
    /// A node is split together with the other one unless its side is a smaller part of that one's.
    static constexpr float much_smaller = 0.5F;

    /// All pairs of the queue over one interval. Those whose paths bend too much go on to the two halves, the earlier
    /// half first, so that a contact there saves the later one. Where there are such, all that may only meet in the
    /// later half waits for it.
    void search_interval(const TimeRange& range) {
        const TimeInterval interval = times_.interval(range);
        std::vector<NodePair> bent;
        while (!queue_.is_empty() && !leaves_.is_over()) {
            const NodePair pair = queue_.pop();
            const double first = range.at(pair.when.lower);
            if (first > leaves_.best() || leaves_.is_kept_apart(pair, first))
                continue;
            if (!bent.empty() && pair.when.lower >= 0.5F)
                bent.push_back(pair);
            else
                visit(pair, interval, bent);
        }
        queue_.clear();
        const double middle = range.at(0.5);
        for (const bool later : {false, true}) {
            if (bent.empty() || leaves_.is_over() || (later && leaves_.best() < middle))
                return;
            for (const NodePair& pair : bent)
                if (const Window when = in_half(pair.when, later); !when.is_empty())
                    queue_.push({pair.moving, pair.fixed, when});
            search_interval(later ? TimeRange{middle, range.upper} : TimeRange{range.lower, middle});
        }
    }

    /// A window of an interval in terms of its earlier or later half. Exact, up to the ends of the half.
    static Window in_half(const Window& when, bool later) {
        const float offset = later ? 1 : 0;
        return {std::max(0.0F, 2 * when.lower - offset), std::min(1.0F, 2 * when.upper - offset)};
    }

    /// A pair that may meet: its features, or its children, or later, in halves of the interval.
    void visit(const NodePair& pair, const TimeInterval& interval, std::vector<NodePair>& bent) {
        const BvhNode& moving = moving_nodes_[pair.moving];
        const BvhNode& fixed = fixed_nodes_[pair.fixed];
        if (is_worth_halving(interval, std::max(side(moving), side(fixed))))
            bent.push_back(pair);
        else if (moving.is_leaf() && fixed.is_leaf())
            leaves_.test(
                FacePair{moving.first, fixed.first, interval.range, pair.when, interval.range.at(queue_.earliest())});
        else
            split(pair, interval);
    }

    /// Not where boxes are as wide for their roundings, which halving does not change.
    [[nodiscard]] bool is_worth_halving(const TimeInterval& interval, double side) const {
        return interval.bend > std::max(bend_of_size * side + bend_of_margin * margin_, interval.rounding) &&
               interval.range.width() > shortest_interval;
    }

    /// A node, or its two children.
    struct Part {
        std::uint32_t first;
        std::uint32_t count;

        [[nodiscard]] TwoNodes of(std::span<const BvhNode> nodes) const {
            return {&nodes[first], &nodes[first + count - 1]};
        }
    };

    /// Both nodes, or the one that is much larger. What may meet earlier is visited earlier.
    void split(const NodePair& pair, const TimeInterval& interval) {
        const BvhNode& moving = moving_nodes_[pair.moving];
        const BvhNode& fixed = fixed_nodes_[pair.fixed];
        const float moving_side = side(moving);
        const float fixed_side = side(fixed);
        const bool moving_splits = !moving.is_leaf() && (fixed.is_leaf() || moving_side >= much_smaller * fixed_side);
        const bool fixed_splits = !fixed.is_leaf() && (moving.is_leaf() || fixed_side >= much_smaller * moving_side);
        const Part a = moving_splits ? Part{moving.first, 2} : Part{pair.moving, 1};
        const Part b = fixed_splits ? Part{fixed.first, 2} : Part{pair.fixed, 1};
        const auto when = interval.boxes.overlap_windows(a.of(moving_nodes_), b.of(fixed_nodes_), pair.when);
        node_pairs_ += a.count * b.count;
        std::array<NodePair, 4> left;
        std::size_t count = 0;
        for (std::uint32_t i = 0; i < a.count; ++i)
            for (std::uint32_t j = 0; j < b.count; ++j)
                if (const Window& window = when[2 * i + j]; !window.is_empty())
                    insert({a.first + i, b.first + j, window}, left, count++);
        for (std::size_t i = 0; i < count; ++i)
            push(left[i]);
    }

    /// Among `count` pairs, the later ones first.
    static void insert(const NodePair& pair, std::array<NodePair, 4>& pairs, std::size_t count) {
        for (; count > 0 && pairs[count - 1].when.lower < pair.when.lower; --count)
            pairs[count] = pairs[count - 1];
        pairs[count] = pair;
    }

    void push(const NodePair& pair) {
        prefetch_children(moving_nodes_, pair.moving);
        prefetch_children(fixed_nodes_, pair.fixed);
        queue_.push(pair);
    }

    /// They are asked for soon, and most often not at hand.
    static void prefetch_children(std::span<const BvhNode> nodes, std::uint32_t node) {
        if (!nodes[node].is_leaf())
            __builtin_prefetch(&nodes[nodes[node].first]);
    }

    static float side(const BvhNode& node) {
        return std::max({node.upper[0] - node.lower[0], node.upper[1] - node.lower[1], node.upper[2] - node.lower[2]});
    }

    std::span<const BvhNode> moving_nodes_;
    std::span<const BvhNode> fixed_nodes_;
    const TimeTree& times_;
    double margin_;
    PairQueue queue_; ///< of the interval at hand
    Leaves& leaves_;
    std::uint64_t node_pairs_ = 0;
};

} // namespace chasles::culling
