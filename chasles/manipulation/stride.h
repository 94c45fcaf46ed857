// How far a step may go where the search for contacts on its way is long.
// Source: docs/derivations/30-dragged-body.md, "The certified step".
#pragma once

#include "chasles/manipulation/surroundings.h"

#include <algorithm>
#include <cstdint>
#include <limits>

namespace chasles::manipulation {

/// Between surfaces that fit tightly, a long way costs a long search, and is blocked soon. There the next step is as
/// short as the way that was free, so that a list of neighbours can serve it. Where steps get through, they get longer
/// again.
class Stride {
public:
    explicit Stride(double margin) : margin_(margin) {}

    /// The share of a way of this length, of the farthest point, that the next step goes.
    [[nodiscard]] double share(double way) const { return way > longest_ ? longest_ / way : 1; }

    /// What came of the step.
    void learn(double way, const Passage& passage) {
        const double tried = share(way) * way;
        if (passage.work.node_pairs > dear && passage.until < soon)
            longest_ = std::max(4 * passage.until * tried, 4 * margin_);
        else if (tried < way)
            longest_ *= 2;
    }

private:
    static constexpr std::uint64_t dear = 200000; ///< pairs of nodes: some 20 ms
    static constexpr double soon = 0x1p-4;        ///< of the way

    double margin_;
    double longest_ = std::numeric_limits<double>::infinity();
};

} // namespace chasles::manipulation
