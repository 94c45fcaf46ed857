// One step of Bezier clipping: the part of an interval outside which a polynomial is proven to be negative.
// Source: T. Sederberg, T. Nishita, "Curve intersection using Bezier clipping", 1990; note 06 counts the roundings
// (docs/derivations/06-first-feasible.md).
#pragma once

#include "chasles/algebra/bernstein.h"
#include "chasles/algebra/unit_roundoff.h"

#include <algorithm>
#include <cmath>

namespace chasles::algebra::detail {

/// A part of [0, 1] that the search has not excluded. Its ends have the precision of the scalar.
template <class Scalar>
struct Subinterval {
    Scalar lower;
    Scalar upper;
    [[nodiscard]] Scalar width() const { return upper - lower; }
};

/// The nearest double to x, or its lower neighbour if the nearest double is above x. x is in [0, 1].
template <class Scalar>
double rounded_down(const Scalar& x) {
    const double nearest = static_cast<double>(x);
    return Scalar(nearest) > x ? std::nextafter(nearest, -1.0) : nearest;
}
/// The nearest double to x, or its upper neighbour if the nearest double is below x. x is in [0, 1].
template <class Scalar>
double rounded_up(const Scalar& x) {
    const double nearest = static_cast<double>(x);
    return Scalar(nearest) < x ? std::nextafter(nearest, 2.0) : nearest;
}

/// The remaining part of an interval, as fractions of the interval.
struct Clip {
    double lower = 0;
    double upper = 1;
    [[nodiscard]] bool is_empty() const { return lower > upper; }
};

/// Added to each end of a clip. It covers the rounding of the fraction and the rounding in `clipped`.
inline constexpr double clip_slack = 0x1p-50;

/// Extends the clip to the zeros of the lines between point i, which is >= 0, and every negative point j.
template <int Degree, class Scalar>
void extend_to_crossings(Clip& clip, const Bernstein<Degree, Scalar>& high, int i) {
    const double position = double(i) / Degree;
    for (int j = 0; j <= Degree; ++j) {
        if (!(high[j] < Scalar(0)))
            continue;
        const double share = static_cast<double>(Scalar(high[i] / (high[i] - high[j])));
        const double root = position + (double(j) / Degree - position) * share;
        clip.lower = std::min(clip.lower, root - clip_slack);
        clip.upper = std::max(clip.upper, root + clip_slack);
    }
}

/// The clip in which the convex hull of the points (i / Degree, high_i) may be >= 0. A polynomial that is nowhere above
/// `high` is proven to be negative outside the clip.
template <int Degree, class Scalar>
Clip clip_to_nonnegative(const Bernstein<Degree, Scalar>& high) {
    const Scalar zero(0);
    if (is_positive(high, Bernstein<Degree, Scalar>()))
        return {};
    Clip clip{1, 0};
    for (int i = 0; i <= Degree; ++i) {
        if (high[i] < zero)
            continue;
        const double position = double(i) / Degree;
        clip.lower = std::min(clip.lower, position);
        clip.upper = std::max(clip.upper, position);
        extend_to_crossings(clip, high, i);
    }
    return {std::max(clip.lower, 0.0), std::min(clip.upper, 1.0)};
}

inline Clip intersection(const Clip& a, const Clip& b) {
    return {std::max(a.lower, b.lower), std::min(a.upper, b.upper)};
}

/// The part of the interval that a clip leaves over, rounded outward but never beyond the interval.
template <class Scalar>
Subinterval<Scalar> clipped(const Subinterval<Scalar>& part, const Clip& clip) {
    const Scalar slack = Scalar(2 * unit_roundoff<Scalar>) * part.upper;
    const Scalar lower = part.lower + Scalar(clip.lower) * part.width() - slack;
    const Scalar upper = part.lower + Scalar(clip.upper) * part.width() + slack;
    return {clip.lower <= 0 || lower < part.lower ? part.lower : lower,
            clip.upper >= 1 || upper > part.upper ? part.upper : upper};
}

} // namespace chasles::algebra::detail
