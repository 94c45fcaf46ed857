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
    /// limit.
    void run(const std::function<bool()>& is_enough);

    enum class Kind : std::uint8_t { open, clear, contact, divided };
    [[nodiscard]] double open_share() const { return open_share_; }
    [[nodiscard]] const std::optional<RangeWitness>& witness() const { return witness_; }
    /// Whether every cell is proven clear.
    [[nodiscard]] bool is_clear() const;
    /// The cells of a kind. Both halves of a cell that are of one kind are one.
    [[nodiscard]] std::vector<RangeCell> cells(Kind kind) const;
    /// Of cells that were examined.
    [[nodiscard]] std::size_t count() const { return count_; }

private:
    /// A cell of the tree of halves.
    struct Node {
        std::vector<RangeCell::Side> sides;
        Kind kind = Kind::open;
        std::size_t first_half = 0; ///< the second one follows it
    };
    struct Waiting {
        double share;
        std::size_t node;
        RangeCell cell;

        /// The largest and then the oldest one is the last.
        friend bool operator<(const Waiting& a, const Waiting& b) {
            return a.share != b.share ? a.share < b.share : a.node > b.node;
        }
    };
    void add(RangeCell cell);
    void wait(std::size_t node, RangeCell cell);
    bool run_round();
    void take(std::size_t node, RangeSearch::Outcome outcome);
    [[nodiscard]] std::vector<Kind> joined_kinds() const;

    const RangeSearch& search_;
    const RangeOptions& options_;
    std::vector<Node> nodes_;      ///< halves after the whole
    std::vector<Waiting> waiting_; ///< a heap
    std::optional<RangeWitness> witness_;
    double open_share_ = 1;
    std::size_t count_ = 0;
};

} // namespace chasles::robot
