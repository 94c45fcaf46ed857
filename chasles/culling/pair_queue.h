// The pairs of nodes that are still to be visited in one interval of time.
#pragma once

#include "chasles/culling/swept_boxes.h"

#include <array>
#include <bit>
#include <cstdint>
#include <vector>

namespace chasles::culling {

/// A pair of nodes, one of each hierarchy, that may meet in a part of the interval at hand.
struct NodePair {
    std::uint32_t moving;
    std::uint32_t fixed;
    Window when;
};

/// The last one in is the first one out, so that its nodes are still at hand. By time, pairs that may meet earlier come
/// before that, in steps of a part of the interval. In and out cost the same, however many there are.
class PairQueue {
public:
    explicit PairQueue(bool by_time) : steps_(by_time ? 64 : 1) {}

    [[nodiscard]] bool is_empty() const { return occupied_ == 0; }

    /// Where the windows of all that are left begin, up to rounding, at the earliest. By time only.
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

    /// There has to be one.
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
        std::uint32_t next; ///< below it in its step, or the next unused one
    };

    int steps_;
    std::vector<Entry> entries_;
    std::uint32_t unused_ = none;
    std::uint64_t occupied_ = 0; ///< a bit for each step that has some
    std::array<std::uint32_t, 64> tops_;
};

} // namespace chasles::culling
