// The input and the answer of `first_feasible`: a function F, inequalities, tolerances, and an interval.
// Source: docs/derivations/06-first-feasible.md.
#pragma once

#include "chasles/algebra/bernstein.h"

#include <optional>
#include <span>

namespace chasles::algebra {

/// A polynomial with an error bound: coefficient i differs from the exact coefficient by at most error * weight_i.
template <int Degree, class Scalar>
struct Bounded {
    Bernstein<Degree, Scalar> polynomial;
    Scalar error{};
};

/// The inequality first(tau) >= 0, or, with an alternative, "first(tau) >= 0 or second(tau) >= 0". A span adds the same
/// inequality for span W - first and span W - second. Both together state that the interval between first / W and
/// second / W intersects [0, span].
template <int Degree, class Scalar>
struct Constraint {
    Bounded<Degree, Scalar> first;
    Bounded<Degree, Scalar> second{};
    bool has_alternative = false;
    std::optional<Scalar> span{};
};

/// Calls `holds(polynomial, second polynomial or nullptr)` for the one or two inequalities of a constraint and returns
/// false as soon as one call returns false. The polynomials are given on some part of [0, 1]. `second` is ignored
/// without an alternative.
template <int Degree, class Scalar, class Predicate>
bool all_inequalities(const Constraint<Degree, Scalar>& constraint, const Bernstein<Degree, Scalar>& weight,
                      const Bernstein<Degree, Scalar>& first, const Bernstein<Degree, Scalar>& second,
                      Predicate holds) {
    const auto visit = [&](const Bernstein<Degree, Scalar>& p, const Bernstein<Degree, Scalar>& q) {
        return holds(p, constraint.has_alternative ? &q : nullptr);
    };
    if (!visit(first, second))
        return false;
    if (!constraint.span)
        return true;
    const Bernstein<Degree, Scalar> end = weight * *constraint.span;
    return visit(end - first, end - second);
}

/// F and the constraints over one positive weight polynomial.
template <int Degree, class Scalar>
struct FeasibilityProblem {
    Bernstein<Degree, Scalar> weight;
    Bounded<Degree, Scalar> function;
    std::span<const Constraint<Degree, Scalar>> constraints;
};

/// The answer of `first_feasible`. It proves that no feasible tau lies before `lower`.
struct FeasibleInterval {
    double lower = 0;
    double upper = 1;
    /// A root of the exact F at which all exact constraints hold is proven to lie in [lower, upper].
    bool certain = false;
};

/// The part of [0, 1] that is searched first.
struct Focus {
    double lower = 0; ///< an earlier search has proven that no feasible tau lies before it
    double upper = 1; ///< the rest of [0, 1] after it is searched last
};

/// When the search stops. All widths are in tau.
struct Tolerance {
    double width = 1e-12;      ///< greatest width of an answer that is certain
    double resolution = 1e-12; ///< a part that is narrower than this is reported as uncertain
    int restrictions = 10'000; ///< after this many restrictions the current part is reported as uncertain
    Focus focus{};
};

} // namespace chasles::algebra
