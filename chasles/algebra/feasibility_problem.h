// What first_feasible is asked and what it answers. Source: docs/derivations/06-first-feasible.md.
#pragma once

#include "chasles/algebra/bernstein.h"

#include <optional>
#include <span>

namespace chasles::algebra {

/// A polynomial whose coefficient i differs from the exact one by at most error * weight_i.
template <int Degree, class Scalar>
struct Bounded {
    Bernstein<Degree, Scalar> polynomial;
    Scalar error{};
};

/// Demands first(tau) >= 0; with an alternative, first(tau) >= 0 or second(tau) >= 0. With a span it demands the same
/// of span W - first and span W - second besides, so that the values over W from first to second meet [0, span].
template <int Degree, class Scalar>
struct Constraint {
    Bounded<Degree, Scalar> first;
    Bounded<Degree, Scalar> second{};
    bool has_alternative = false;
    std::optional<Scalar> span{};
};

/// Calls `demand(polynomial, second polynomial or nullptr)` for the one or two demands of a constraint, given its
/// polynomials on some part (`second` is not looked at without an alternative), until one returns false.
template <int Degree, class Scalar, class Demand>
bool all_demands(const Constraint<Degree, Scalar>& constraint, const Bernstein<Degree, Scalar>& weight,
                 const Bernstein<Degree, Scalar>& first, const Bernstein<Degree, Scalar>& second, Demand demand) {
    const auto ask = [&](const Bernstein<Degree, Scalar>& p, const Bernstein<Degree, Scalar>& q) {
        return demand(p, constraint.has_alternative ? &q : nullptr);
    };
    if (!ask(first, second))
        return false;
    if (!constraint.span)
        return true;
    const Bernstein<Degree, Scalar> end = weight * *constraint.span;
    return ask(end - first, end - second);
}

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

/// Where to look first.
struct Focus {
    double lower = 0; ///< nothing feasible is before it: so an earlier search has proven
    double upper = 1; ///< what is after it is looked at last
};

/// When to stop.
struct Tolerance {
    double width = 1e-12;      ///< of an interval that holds a root for certain
    double resolution = 1e-12; ///< below it, what is still not certain is reported as it stands
    int restrictions = 10'000; ///< of polynomials to parts of [0, 1]; after so many, likewise
    Focus focus{};
};

} // namespace chasles::algebra
