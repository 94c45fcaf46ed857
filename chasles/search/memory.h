// Which pairs of faces are worth testing, by what earlier searches of the same two bodies have found.
#pragma once

#include "chasles/culling/pair_queue.h"
#include "chasles/culling/time_range.h"
#include "chasles/search/find.h"

#include <optional>
#include <span>

namespace chasles::search {

class PieceContext;

/// This one remembers nothing. What another one holds changes the time of the next searches, their brackets within the
/// tolerance, and the order in which pairs are found.
class Memory {
public:
    Memory() = default;
    Memory(const Memory&) = delete;
    Memory& operator=(const Memory&) = delete;
    virtual ~Memory() = default;

    /// Pairs of leaves, each once, with their windows of `range`: no other faces come within `margin` of each other in
    /// this range of the piece. Valid until the next call. Empty: every pair is worth testing.
    virtual std::optional<std::span<const culling::NodePair>> pairs_worth_testing(const PieceContext& /*context*/,
                                                                                  double /*margin*/,
                                                                                  const culling::TimeRange& /*range*/,
                                                                                  Work& /*work*/) {
        return std::nullopt;
    }
    /// All pairs were tested on a whole piece, at this cost.
    virtual void learn(const PieceContext& /*context*/, const Work& /*work*/) {}
};

/// For questions that stand alone; any thread may use it.
inline Memory& no_memory() {
    static Memory none;
    return none;
}

} // namespace chasles::search
