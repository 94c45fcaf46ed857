// How far a step goes where the search for contacts on its way is long.
// Source: docs/derivations/30-dragged-body.md, "The certified step".
#pragma once

#include <algorithm>
#include <cstdint>

namespace chasles::manipulation {

/// A long way is searched in parts that begin where the body is, each longer than the one before. If the body is
/// blocked soon, the rest is not searched. If time is short, the step ends with the part after which the search has got
/// long.
class Stride {
public:
    explicit Stride(double margin) : least_(8 * margin), first_(least_) {}

    /// Of a way of this length, of the farthest point: the share that is searched first.
    [[nodiscard]] double first_share(double way) const { return std::min(1.0, first_ / way); }
    /// After a share that is free.
    [[nodiscard]] static double next_share(double share) { return std::min(1.0, 4 * share); }
    /// Whether the search of a step has got long, after tests of so many pairs of nodes.
    [[nodiscard]] static bool is_long(std::uint64_t node_pairs) { return node_pairs > long_search; }

    /// What came of a step: how far it went.
    void learn(double gone, bool is_blocked, std::uint64_t node_pairs) {
        if (is_blocked)
            first_ = 2 * gone;
        else if (node_pairs > 2 * long_search)
            first_ = gone / 2;
        else
            first_ = std::max(first_, gone);
        first_ = std::max(first_, least_);
    }

private:
    static constexpr std::uint64_t long_search = 5000; ///< a millisecond, measured with drag_bench

    double least_;
    double first_; ///< the length of the first part of a way
};

} // namespace chasles::manipulation
