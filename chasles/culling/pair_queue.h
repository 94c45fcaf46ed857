// The pairs of nodes that are not yet visited in one interval of time, as a stack or as a queue by time.
// Push and pop take constant time.
#pragma once

#include "chasles/culling/swept_boxes.h"

#include <array>
#include <bit>
#include <cstdint>
#include <vector>

namespace chasles::culling {

/// A pair of nodes, one of each hierarchy, that may touch in a window of the current interval.
struct NodePair {
    std::uint32_t moving;
    std::uint32_t fixed;
    Window when;
};

/// A stack: the pair that was pushed last is popped first, because its nodes are still in the cache. By time, the
/// interval is divided into 64 steps with one stack each. Pairs whose window starts in an earlier step are popped
/// first.
class PairQueue {
public:
    explicit PairQueue(bool by_time) : steps_(by_time ? 64 : 1) {}

    [[nodiscard]] bool is_empty() const { return occupied_ == 0; }

    /// The earliest start of the windows of all pairs, rounded down to a step. Only for a queue by time. 1 if empty.
    [[nodiscard]] float earliest() const { return is_empty() ? 1 : float(first_step()) / float(steps_ - 1); }

    void push(const NodePair& pair) {
        const auto step = static_cast<std::size_t>(pair.when.lower * float(steps_ - 1));
        std::uint32_t place = unused_;
        if (place == none) {
            place = static_cast<std::uint32_t>(entries_.size());
            entries_.reserve(256);
            entries_.emplace_back();
        } else {
            unused_ = entries_[place].next;
        }
        const std::uint64_t bit = std::uint64_t(1) << step;
        entries_[place] = {pair, (occupied_ & bit) != 0 ? tops_[step] : none};
        tops_[step] = place;
        occupied_ |= bit;
    }

    /// Removes and returns the next pair. The queue must not be empty.
    NodePair pop() {
        const std::size_t step = first_step();
        const std::uint32_t place = tops_[step];
        Entry& entry = entries_[place];
        tops_[step] = entry.next;
        if (entry.next == none)
            occupied_ &= occupied_ - 1;
        entry.next = unused_;
        unused_ = place;
        return entry.pair;
    }

    void clear() {
        entries_.clear();
        unused_ = none;
        occupied_ = 0;
    }

private:
    static constexpr std::uint32_t none = 0xffffffff;

    [[nodiscard]] std::size_t first_step() const { return static_cast<std::size_t>(std::countr_zero(occupied_)); }

    struct Entry {
        NodePair pair;
        std::uint32_t next; ///< the entry below in the same step, or the next unused entry
    };

    int steps_;
    std::vector<Entry> entries_;
    std::uint32_t unused_ = none;
    std::uint64_t occupied_ = 0;         ///< one bit for each step with entries
    std::array<std::uint32_t, 64> tops_; ///< the top entry of each occupied step
};

} // namespace chasles::culling
