// Time of a whole motion and the part of it that one piece takes.
// Source: docs/derivations/10-error-bounds.md, "Time".
#pragma once

#include "chasles/algebra/bracket.h"

#include <algorithm>
#include <cstddef>

namespace chasles::motion {

/// Piece `index` of `count` equal parts of the time [0, 1].
struct PieceClock {
    std::size_t index = 0;
    std::size_t count = 1;

    /// A bracket within the piece, in [0, 1], as a bracket within the whole motion. Rounds outward.
    [[nodiscard]] Bracket whole(const Bracket& part) const {
        const double tiny = part.upper > 0 ? underflow_slack : 0;
        return {std::max(0.0, whole(part.lower) * (1 - rounding_slack)),
                std::min(1.0, whole(part.upper) * (1 + rounding_slack) + tiny)};
    }

private:
    /// Rounding of tau, of two arc tangents good to 0.51 units in the last place each, and of the sum with the
    /// index: 9.1 of 16 units at most.
    static constexpr double rounding_slack = 0x1p-49;
    /// The largest loss to underflow in a tau or time above 0.
    static constexpr double underflow_slack = 0x1p-1022;

    [[nodiscard]] double whole(double part) const { return (double(index) + part) / double(count); }
};

} // namespace chasles::motion
