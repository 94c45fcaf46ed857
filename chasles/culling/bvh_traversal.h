// The traversal of both bounding volume hierarchies (BVHs) in space and time. It visits every pair of faces that may
// touch, with the time window in which the pair may touch. Source: docs/derivations/07-swept-boxes.md,
// 14-node-pairs.md.
#pragma once

#include "chasles/culling/pair_queue.h"
#include "chasles/culling/split_nodes.h"
#include "chasles/culling/time_tree.h"

#include <algorithm>
#include <array>
#include <bit>
#include <span>
#include <vector>

namespace chasles::culling {

/// Two faces that may touch in a part of an interval.
struct FacePair {
    std::uint32_t moving;
    std::uint32_t fixed;
    TimeRange interval;
    Window when;
    double first_left; ///< the earliest time of all pairs that are not yet visited in the interval
    double deviation;  ///< by how much points that touch in the interval leave their chords, in the length unit
};

/// The tests that a traversal calls.
template <class T>
concept LeafTests = requires(T leaves, const FacePair& faces, const NodePair& nodes, double tau) {
    { leaves.best() } -> std::convertible_to<double>;           // pairs that start after this tau are skipped
    { leaves.is_over() } -> std::same_as<bool>;                 // whether to stop the traversal
    { leaves.is_kept_apart(nodes, tau) } -> std::same_as<bool>; // whether another test separates the nodes from tau on
    leaves.test(faces);                                         // tests the features of two faces
};

/// One traversal. Call `run` once.
template <LeafTests Leaves>
class BvhTraversal {
public:
    /// Keeps all references. `by_time`: pairs that may touch earlier are visited first. Points within `margin` of each
    /// other count as touching.
    BvhTraversal(const Bvh& moving, const Bvh& fixed, const TimeTree& times, double margin, bool by_time,
                 Leaves& leaves)
        : moving_nodes_(moving.nodes()), fixed_nodes_(fixed.nodes()), times_(times), margin_(margin),
          deviation_of_size_(times.are_enclosed() ? deviation_of_size_if_enclosed : deviation_of_size), queue_(by_time),
          leaves_(leaves) {}

    /// Visits the pairs that may touch during `range`, which may be one moment. Returns the number of node pairs
    /// tested. Visits the intervals of time without recursion: an interval whose pairs have a large chord deviation is
    /// followed by its earlier half, then by its later half.
    std::uint64_t run(TimeRange range = {}) {
        queue_.push({0, 0, {}}); // both roots
        return run_queue(range);
    }

    /// Likewise for these pairs and what is below them, with their windows of `range`.
    std::uint64_t run_among(std::span<const NodePair> pairs, TimeRange range) {
        for (const NodePair& pair : pairs)
            queue_.push(pair);
        return run_queue(range);
    }

    /// Before this tau all pairs have been visited.
    [[nodiscard]] double visited_until() const { return halvings_.empty() ? 0 : halvings_.back().range.lower; }

private:
    std::uint64_t run_queue(TimeRange range) {
        do {
            const TimeInterval interval = times_.interval(range);
            halvings_.push_back({range, deferred_.size()});
            while (!queue_.is_empty() && !leaves_.is_over())
                visit(queue_.pop(), interval);
            queue_.clear();
        } while (fill_queue_with_next_half(range));
        return node_pairs_;
    }

    /// The interval of a pair is halved if the chord deviation exceeds this fraction of the box size plus this fraction
    /// of the margin. Measured with peers_bench: 0.05 of the size doubles the time for large rotations of large meshes
    /// and saves a tenth for short motions. Measured with margin_bench at a margin of a tenth of the body: without the
    /// margin term the time grows by up to a half; with three times the term it grows more than fourfold.
    static constexpr double deviation_of_size = 0.01;
    /// Where parts of the motion are enclosed, an interval costs more, and the body turns little in it. Measured with
    /// scenes_bench: 0.01 takes 14 % longer, 0.08 takes 20 % longer.
    static constexpr double deviation_of_size_if_enclosed = 0.03;
    static constexpr double deviation_of_margin = 0.001;

    /// An interval whose deferred pairs are to be visited in its halves.
    struct Halving {
        TimeRange range;
        std::size_t first_deferred; ///< its deferred pairs are all from this one on
        int halves_done = 0;
    };

    /// The next half of the innermost interval that has one: its range, with its pairs in the queue. The later half is
    /// skipped if a contact in the earlier half makes it unnecessary. False if there is none.
    bool fill_queue_with_next_half(TimeRange& next) {
        for (; !halvings_.empty(); drop_innermost()) {
            auto& [range, first_deferred, halves_done] = halvings_.back();
            const double middle = range.at(0.5);
            const bool later = halves_done == 1;
            const std::span<const NodePair> deferred = std::span(deferred_).subspan(first_deferred);
            if (deferred.empty() || halves_done == 2 || leaves_.is_over() || (later && leaves_.best() < middle))
                continue;
            ++halves_done;
            for (const NodePair& pair : deferred)
                if (const Window when = in_half(pair.when, later); !when.is_empty())
                    queue_.push({pair.moving, pair.fixed, when});
            next = later ? TimeRange{middle, range.upper} : TimeRange{range.lower, middle};
            return true;
        }
        return false;
    }

    void drop_innermost() {
        deferred_.resize(halvings_.back().first_deferred);
        halvings_.pop_back();
    }
    [[nodiscard]] bool has_deferred() const { return deferred_.size() > halvings_.back().first_deferred; }

    /// Skips a pair that cannot improve the answer, defers it, tests its faces, or splits its nodes. Once a pair is
    /// deferred, all pairs that may only touch in the later half are deferred with it.
    void visit(const NodePair& pair, const TimeInterval& interval) {
        const double first = interval.range.at(pair.when.lower);
        if (first > leaves_.best() || leaves_.is_kept_apart(pair, first))
            return;
        const BvhNode& moving = moving_nodes_[pair.moving];
        const BvhNode& fixed = fixed_nodes_[pair.fixed];
        if (moving.is_bare() && fixed.is_bare())
            return;
        if ((has_deferred() && pair.when.lower >= 0.5F) ||
            is_worth_halving(interval, std::max(longest_side(moving), longest_side(fixed))))
            deferred_.push_back(pair);
        else if (moving.is_leaf() && fixed.is_leaf())
            leaves_.test(FacePair{moving.first, fixed.first, interval.range, pair.when,
                                  interval.range.at(queue_.earliest()), interval.deviation});
        else
            split(pair, interval);
    }

    /// Whether halving pays. It does not if the boxes are mainly widened for rounding, which halving does not reduce.
    [[nodiscard]] bool is_worth_halving(const TimeInterval& interval, double side) const {
        return interval.deviation >
                   std::max(deviation_of_size_ * side + deviation_of_margin * margin_, interval.rounding) &&
               interval.range.width() > shortest_interval;
    }

    /// Splits both nodes, or only the much larger node. Pushes the pairs with the earliest window last.
    void split(const NodePair& pair, const TimeInterval& interval) {
        const auto [a, b] = split_nodes(moving_nodes_, pair.moving, fixed_nodes_, pair.fixed);
        const auto when = interval.boxes.overlap_windows(a.of(moving_nodes_), b.of(fixed_nodes_), pair.when);
        node_pairs_ += std::uint64_t(a.count) * b.count;
        // The queue is a stack within one step of time: the pair that is pushed last is visited first.
        std::array<NodePair, 4> remaining;
        std::size_t count = 0;
        for (unsigned left = open_windows(when) & pairs_of(a.count, b.count); left != 0; left &= left - 1) {
            const auto place = unsigned(std::countr_zero(left));
            insert({a.first + place / 2, b.first + place % 2, when[place]}, remaining, count++);
        }
        for (std::size_t i = 0; i < count; ++i)
            push(remaining[i]);
    }

    /// One bit for each window that is not empty. Without branches: they could not be foretold.
    static unsigned open_windows(const SweptBoxes::Windows& windows) {
        unsigned open = 0;
        for (unsigned i = 0; i < windows.size(); ++i)
            open |= unsigned(!windows[i].is_empty()) << i;
        return open;
    }
    /// One bit for each of the pairs 00, 01, 10, 11 that there is.
    static unsigned pairs_of(std::uint32_t moving, std::uint32_t fixed) {
        return (moving == 2 ? 0b1111U : 0b0011U) & (fixed == 2 ? 0b1111U : 0b0101U);
    }

    /// Inserts a pair into `count` pairs, which are sorted with the latest window first.
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

    /// The children are needed soon and are usually not in the cache.
    static void prefetch_children(std::span<const BvhNode> nodes, std::uint32_t node) {
        if (!nodes[node].is_leaf())
            __builtin_prefetch(&nodes[nodes[node].first]);
    }

    std::span<const BvhNode> moving_nodes_;
    std::span<const BvhNode> fixed_nodes_;
    const TimeTree& times_;
    double margin_;
    double deviation_of_size_;
    PairQueue queue_; ///< pairs of the current interval
    Leaves& leaves_;
    std::vector<Halving> halvings_;  ///< the innermost last
    std::vector<NodePair> deferred_; ///< of all intervals, those of the innermost last
    std::uint64_t node_pairs_ = 0;
};

} // namespace chasles::culling
