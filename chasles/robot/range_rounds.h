// The order in which cells of a box of configurations are examined: rounds of the largest ones.
// Source: docs/derivations/40-ranges.md, "Rounds".
#pragma once

#include "chasles/robot/range_search.h"

#include <functional>
#include <optional>
#include <vector>

namespace chasles::robot {

/// Throws InvalidInput for an option out of its range.
void check_options(const RangeOptions& options);

class RangeRounds {
public:
    /// Both are kept by reference.
    RangeRounds(const RangeSearch& search, const RangeOptions& options);

    /// Examines cells until `is_enough`, which is called after each round, until no cell can be divided, or up to a
    /// limit. False at the limit of the thread.
    bool run(const std::function<bool()>& is_enough);

    [[nodiscard]] double open_share() const { return open_share_; }
    [[nodiscard]] const std::optional<RangeWitness>& witness() const { return witness_; }
    [[nodiscard]] const std::vector<RangeCell>& clear() const { return clear_; }
    [[nodiscard]] const std::vector<RangeCell>& contact() const { return contact_; }
    /// What is left, whether it can be divided or not.
    [[nodiscard]] std::vector<RangeCell> open() const;
    [[nodiscard]] std::size_t cells() const { return cells_; }

private:
    struct Waiting {
        double share;
        std::size_t number; ///< in the order in which cells were made
        RangeCell cell;

        /// The largest and then the oldest one is the last.
        friend bool operator<(const Waiting& a, const Waiting& b) {
            return a.share != b.share ? a.share < b.share : a.number > b.number;
        }
    };
    void add(RangeCell cell);
    bool run_round();
    void take(RangeCell cell, RangeSearch::Outcome outcome);

    const RangeSearch& search_;
    const RangeOptions& options_;
    std::vector<Waiting> waiting_; ///< a heap
    std::vector<RangeCell> clear_, contact_, indivisible_;
    std::optional<RangeWitness> witness_;
    double open_share_ = 1;
    std::size_t cells_ = 0;
    std::size_t made_ = 0;
};

} // namespace chasles::robot
