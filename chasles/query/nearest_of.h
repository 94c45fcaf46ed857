// Which of many pairs comes nearest? They are asked one by one, best those first that may be near.
// Source: docs/derivations/21-least-distance.md, "Of many pairs".
#pragma once

#include "chasles/query/pair_query.h"

#include <limits>
#include <optional>

namespace chasles::query {

class NearestOf {
public:
    /// The options have been checked, and are kept by reference.
    explicit NearestOf(const LeastDistanceOptions& options) : options_(options) {
        constexpr double infinity = std::numeric_limits<double>::infinity();
        nearest_.distance = {infinity, infinity};
    }

    [[nodiscard]] bool has_any() const { return has_any_; }
    /// Of the nearest pair so far, or infinity.
    [[nodiscard]] double upper() const { return nearest_.distance.upper; }
    [[nodiscard]] bool touches() const { return upper() == 0; }
    [[nodiscard]] const Work& work() const { return work_; }

    /// The least distance of a pair, unless it is proven to be no less than that of the nearest one so far. Throws
    /// Cancelled at the limit of the thread.
    std::optional<LeastDistance> ask(const Body& moving, const Body& fixed, const motion::AnyTrajectory& trajectory);
    /// Takes what ask() has answered, with times that count for all pairs. Whether this pair is now the nearest one:
    /// nearer, or as near and earlier.
    bool take(LeastDistance found);
    /// The pairs that are left may be as near as this.
    void leave(double lower);

    /// The answer of the nearest pair with the bracket of all pairs.
    [[nodiscard]] LeastDistance result() const;

private:
    [[nodiscard]] double searched_distance() const { return upper() * (1 - 0.5 * options_.tolerance); }

    const LeastDistanceOptions& options_;
    LeastDistance nearest_;
    bool has_any_ = false;
    Work work_;
};

} // namespace chasles::query
