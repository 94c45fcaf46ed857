// A piece of motion as lists of neighbours see it: how far points get on it, and how far they came in all.
// Source: docs/derivations/31-neighbour-lists.md, "Limits".
#pragma once

#include "chasles/culling/interval_ends.h"
#include "chasles/search/piece_context.h"

#include <optional>

namespace chasles::memory {

/// A piece with a margin. Points that come within the margin move on chords between both ends, up to the deviation.
struct Way {
    culling::IntervalEnds ends;
    double margin = 0;
    double deviation = 0;
    double rounding = 0; ///< of positions
    double travel = 0;   ///< a bound of how far such points get from their places at the start

    [[nodiscard]] bool rests() const { return travel <= deviation + 2 * rounding; }
    /// What is apart by more at both ends of the way, along one direction, does not come within the margin.
    [[nodiscard]] double least_gap() const { return margin + deviation + 2 * rounding; }
};

/// `whole` is the interval of the whole piece for points within the margin.
Way way_of(const search::PieceContext& context, const culling::TimeInterval& whole, double margin);

/// The place to which the moving body came.
struct Arrival {
    double share = 0;     ///< of the last way, about
    double beside = 0;    ///< a bound of how far points are from their places on the chords at this share
    double travelled = 0; ///< a bound of how far points have gone in all
};

/// Sums up the ways of a body.
class Travel {
public:
    /// The body is kept by reference.
    explicit Travel(const Body& moving) : moving_(moving) {}

    /// The body stands at the start of a way, and is to go this way next. Since the last call, it may have gone
    /// anywhere.
    Arrival go_to(const Way& way);
    /// How far points have gone up to the last call; 0 again after `restart`.
    [[nodiscard]] double sum() const { return sum_; }
    void restart() { sum_ = 0; }

private:
    const Body& moving_;
    std::optional<culling::IntervalEnds> last_; ///< of the last way
    double sum_ = 0;
};

/// The sum of a limit and what is travelled is rounded to less than this much more than it is.
inline double with_rounding(double travelled) {
    return travelled * (1 + 0x1p-50);
}

} // namespace chasles::memory
