// The one question behind every elementary detection: the first tau in [0, 1] with F(tau) = 0 and all constraints
// satisfied, for polynomials whose coefficients are known to within a bound. Never misses, and stops at a tolerance.
// Source: T. Sederberg, T. Nishita, "Curve intersection using Bezier clipping", 1990; the bounds, the proof and the
// cost are in docs/derivations/06-first-feasible.md.
#pragma once

#include "chasles/algebra/bernstein.h"

#include <algorithm>
#include <optional>
#include <span>

namespace chasles::algebra {

/// A polynomial whose coefficient i differs from the exact one by at most error * weight_i.
template <int Degree, class Scalar>
struct Bounded {
    Bernstein<Degree, Scalar> polynomial;
    Scalar error{};
};

/// Demands first(tau) >= 0, or, with an alternative, first(tau) >= 0 or second(tau) >= 0.
template <int Degree, class Scalar>
struct Constraint {
    Bounded<Degree, Scalar> first;
    Bounded<Degree, Scalar> second{};
    bool has_alternative = false;
};

/// F and the constraints over one positive weight polynomial.
template <int Degree, class Scalar>
struct FeasibilityProblem {
    Bernstein<Degree, Scalar> weight;
    Bounded<Degree, Scalar> function;
    std::span<const Constraint<Degree, Scalar>> constraints;
};

/// What `first_feasible` found: nothing feasible lies before `lower`.
struct FeasibleInterval {
    double lower = 0;
    double upper = 1;
    /// A root of the exact F at which all exact constraints hold is proven to lie in [lower, upper].
    bool certain = false;
};

namespace detail {

/// A part of [0, 1] that is still to be searched.
struct Part {
    double lower;
    double upper;
    [[nodiscard]] double width() const { return upper - lower; }
};

/// Fractions of a part that a clip leaves over; empty when lower > upper.
struct Clip {
    double lower = 0;
    double upper = 1;
};

/// A fraction rounded so that clipping never cuts off too much.
inline constexpr double clip_slack = 0x1p-50;

/// Where the hull of the points (i / Degree, high_i) may be >= 0. Everything outside is proven negative.
template <int Degree, class Scalar>
Clip clip_to_nonnegative(const Bernstein<Degree, Scalar>& high) {
    const Scalar zero(0);
    Clip clip{1, 0};
    for (int i = 0; i <= Degree; ++i) {
        if (high[i] < zero)
            continue;
        const double position = double(i) / Degree;
        clip.lower = std::min(clip.lower, position);
        clip.upper = std::max(clip.upper, position);
        for (int j = 0; j <= Degree; ++j) { // where the line from a negative point j rises through zero
            if (!(high[j] < zero))
                continue;
            const double share = static_cast<double>(Scalar(high[i] / (high[i] - high[j])));
            const double root = position + (double(j) / Degree - position) * share;
            clip.lower = std::min(clip.lower, root - clip_slack);
            clip.upper = std::max(clip.upper, root + clip_slack);
        }
    }
    return {std::max(clip.lower, 0.0), std::min(clip.upper, 1.0)};
}

inline Clip intersection(const Clip& a, const Clip& b) {
    return {std::max(a.lower, b.lower), std::min(a.upper, b.upper)};
}

/// Searches one problem. Parts are restricted afresh from the given coefficients, so that rounding does not build up.
template <int Degree, class Scalar>
class FeasibilitySearch {
public:
    using Polynomial = Bernstein<Degree, Scalar>;
    using Problem = FeasibilityProblem<Degree, Scalar>;

    FeasibilitySearch(const Problem& problem, double tolerance, Part whole)
        : problem_(problem), tolerance_(tolerance), whole_(whole) {}

    std::optional<FeasibleInterval> run() const {
        Part part = whole_;
        std::array<Part, 64> later; // right halves, the earliest on top; a left half is at most 63 halvings deep
        std::size_t waiting = 0;
        for (int steps = 0;; ++steps) {
            const Clip clip = clipped(part);
            if (clip.lower > clip.upper) {
                if (waiting == 0)
                    return std::nullopt;
                part = later[--waiting];
                continue;
            }
            const Part smaller = part_of(part, clip);
            const double middle = smaller.lower + smaller.width() / 2;
            const bool is_final = smaller.width() <= 0.5 * tolerance_ || middle <= smaller.lower ||
                                  middle >= smaller.upper || steps >= step_limit || waiting == later.size();
            if (is_final)
                return answer(smaller);
            if (smaller.width() > 0.5 * part.width()) {
                later[waiting++] = {middle, smaller.upper};
                part = {smaller.lower, middle};
            } else {
                part = smaller;
            }
        }
    }

private:
    /// No search goes on for ever: what is left after so many steps is reported as an uncertain contact.
    static constexpr int step_limit = 1000;

    static Part part_of(const Part& part, const Clip& clip) {
        const double slack = 0x1p-52 * std::max(part.lower, part.upper);
        const double lower = clip.lower <= 0 ? part.lower : part.lower + clip.lower * part.width() - slack;
        const double upper = clip.upper >= 1 ? part.upper : part.lower + clip.upper * part.width() + slack;
        return {std::max(part.lower, lower), std::min(part.upper, upper)};
    }

    [[nodiscard]] Polynomial on(const Polynomial& p, const Part& part) const {
        return restricted(p, Scalar(part.lower), Scalar(part.upper));
    }

    /// The fractions of `part` where F may vanish and every constraint may hold.
    [[nodiscard]] Clip clipped(const Part& part) const {
        const Polynomial weight = on(problem_.weight, part);
        const Polynomial function = on(problem_.function.polynomial, part);
        const Polynomial band = weight * problem_.function.error;
        Clip clip = clip_to_nonnegative(band + function);
        clip = intersection(clip, clip_to_nonnegative(band - function));
        for (const auto& constraint : problem_.constraints) {
            if (clip.lower > clip.upper)
                return clip;
            clip = intersection(clip, clip_to_nonnegative(upper_bound(constraint, weight, part)));
        }
        return clip;
    }

    /// Coefficients not below those of the exact constraint; for alternatives, of the larger of the two.
    [[nodiscard]] Polynomial upper_bound(const Constraint<Degree, Scalar>& constraint, const Polynomial& weight,
                                         const Part& part) const {
        const auto bound = [&](const Bounded<Degree, Scalar>& side) {
            return on(side.polynomial, part) + weight * side.error;
        };
        if (!constraint.has_alternative)
            return bound(constraint.first);
        return Polynomial(maximum(bound(constraint.first).coefficients, bound(constraint.second).coefficients));
    }

    /// Certain if F changes sign and all constraints hold for certain on a slightly wider part. Whatever lies before
    /// `part` was excluded, so that the root is in it or in the rim above.
    [[nodiscard]] FeasibleInterval answer(const Part& part) const {
        const double rim = std::max(part.width(), 0x1p-50 * part.upper);
        const Part wider{std::max(whole_.lower, part.lower - rim), std::min(whole_.upper, part.upper + rim)};
        const bool certain = is_certain(wider);
        return {part.lower, certain ? wider.upper : part.upper, certain};
    }

    [[nodiscard]] bool is_certain(const Part& wider) const {
        const Polynomial weight = on(problem_.weight, wider);
        const Polynomial function = on(problem_.function.polynomial, wider);
        const Polynomial band = weight * problem_.function.error;
        const bool falls = function[0] > band[0] && Scalar(Scalar(0) - function[Degree]) > band[Degree];
        const bool rises = Scalar(Scalar(0) - function[0]) > band[0] && function[Degree] > band[Degree];
        if (!falls && !rises)
            return false;
        const auto holds = [&](const Bounded<Degree, Scalar>& side) {
            return is_positive(on(side.polynomial, wider), weight * side.error);
        };
        return std::all_of(problem_.constraints.begin(), problem_.constraints.end(), [&](const auto& constraint) {
            return holds(constraint.first) || (constraint.has_alternative && holds(constraint.second));
        });
    }

    const Problem& problem_;
    double tolerance_;
    Part whole_;
};

} // namespace detail

/// The first tau in [from, to], a part of [0, 1], where F may vanish and every constraint may hold. Empty: proven that
/// there is none. Otherwise nothing feasible lies before `lower`, and `upper - lower` is at most `tolerance` unless F
/// or the constraints graze zero by less than their error bounds. The errors must include the rounding of
/// `restricted` (3 Degree unit roundoffs of the largest coefficient over its weight).
template <int Degree, class Scalar>
std::optional<FeasibleInterval> first_feasible(const FeasibilityProblem<Degree, Scalar>& problem, double tolerance,
                                               double from = 0, double to = 1) {
    return detail::FeasibilitySearch<Degree, Scalar>(problem, tolerance, {from, to}).run();
}

} // namespace chasles::algebra
