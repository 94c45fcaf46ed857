#include "chasles/query/nearest_of.h"

#include "chasles/base/limit_of_thread.h"

#include <algorithm>

namespace chasles::query {

/// Whether a pair comes nearer is one question with a margin, which the bracket of the answer leaves room for.
std::optional<LeastDistance> NearestOf::ask(const Body& moving, const Body& fixed,
                                            const motion::AnyTrajectory& trajectory) {
    throw_if_cancelled();
    const double margin = searched_distance();
    if (has_any_ && margin <= Pose::largest_length) { // a margin is no larger
        const FirstContact found =
            answer({moving, fixed, trajectory, QueryOptions{.margin = margin, .find = Find::any}});
        work_ += found.work;
        if (found.verdict == Verdict::clear) {
            leave(margin);
            return std::nullopt;
        }
    }
    LeastDistance found = answer(LeastPairQuery{moving, fixed, trajectory, options_});
    work_ += found.work;
    return found;
}

bool NearestOf::take(LeastDistance found) {
    const double lower = std::min(nearest_.distance.lower, found.distance.lower);
    const bool is_nearest = !has_any_ || found.distance.upper < upper() ||
                            (found.distance.upper == upper() && found.time.lower < nearest_.time.lower);
    if (is_nearest)
        nearest_ = std::move(found);
    nearest_.distance.lower = lower;
    has_any_ = true;
    return is_nearest;
}

void NearestOf::leave(double lower) {
    nearest_.distance.lower = std::min(nearest_.distance.lower, lower);
}

LeastDistance NearestOf::result() const {
    LeastDistance result = nearest_;
    const auto& [lower, upper] = result.distance;
    if (!has_any_)
        result.certain = lower == upper; // infinite: there is no pair
    else if (!touches())
        result.certain = upper - lower <= options_.tolerance * upper;
    result.work = work_;
    return result;
}

} // namespace chasles::query
