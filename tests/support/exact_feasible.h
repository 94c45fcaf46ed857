// The exact answer to "the first tau in [0, 1] with F = 0 and all constraints satisfied", by Sturm's theorem.
#pragma once

#include "chasles/algebra/first_feasible.h"
#include "tests/support/algebraic_roots.h"

#include <optional>

namespace chasles::test {

/// A problem that owns its constraints.
template <int Degree, class S>
struct OwnedProblem {
    Bernstein<Degree, S> weight = Bernstein<Degree, S>::constant(S(1));
    algebra::Bounded<Degree, S> function{};
    std::vector<algebra::Constraint<Degree, S>> constraints{};

    [[nodiscard]] std::optional<algebra::FeasibleInterval> solve(const algebra::Tolerance& tolerance = {}) const {
        return algebra::first_feasible<Degree, S>({weight, function, constraints}, tolerance);
    }
};

/// The error that first_feasible requires: the rounding of restriction, and of the difference to the end of a span.
template <int Degree, class S>
algebra::Bounded<Degree, S> with_rounding(const Bernstein<Degree, S>& p, double span = 0) {
    const double size = static_cast<double>(largest_coefficient(exact(p))) + span;
    return {p, S((algebra::restriction_units<Degree> + (span > 0 ? 2 : 0)) * algebra::unit_roundoff<S> * size)};
}

/// The problem in another scalar with the weight 1 and the rounding errors of this scalar.
template <class S, int Degree>
OwnedProblem<Degree, S> in_scalar(const OwnedProblem<Degree, Rational>& problem) {
    OwnedProblem<Degree, S> result;
    result.function = with_rounding(rounded_to<S>(problem.function.polynomial));
    for (const auto& constraint : problem.constraints) {
        const double span = constraint.span ? static_cast<double>(*constraint.span) : 0;
        result.constraints.push_back({with_rounding(rounded_to<S>(constraint.first.polynomial), span),
                                      with_rounding(rounded_to<S>(constraint.second.polynomial), span),
                                      constraint.has_alternative,
                                      constraint.span ? std::optional(S(span)) : std::nullopt});
    }
    return result;
}

/// The conditions of a constraint with the weight 1. Each condition is a list of polynomials, one of which must not be
/// negative.
template <int Degree, class S>
std::vector<std::vector<PowerPolynomial>> demands_of(const algebra::Constraint<Degree, S>& constraint) {
    std::vector<PowerPolynomial> sides{power_form(exact(constraint.first.polynomial))};
    if (constraint.has_alternative)
        sides.push_back(power_form(exact(constraint.second.polynomial)));
    std::vector<std::vector<PowerPolynomial>> demands{sides};
    if (!constraint.span)
        return demands;
    for (PowerPolynomial& side : sides)
        side = sum({exact(*constraint.span)}, scaled(side, Rational(-1)));
    demands.push_back(sides);
    return demands;
}

template <int Degree, class S>
bool holds_exactly_at(const algebra::Constraint<Degree, S>& constraint, const AlgebraicRoot& root) {
    const auto demands = demands_of(constraint);
    return std::all_of(demands.begin(), demands.end(), [&](const std::vector<PowerPolynomial>& sides) {
        return std::any_of(sides.begin(), sides.end(),
                           [&](const PowerPolynomial& side) { return sign_at(side, root) >= 0; });
    });
}

/// Candidates for the first feasible tau: the roots of F, or the ends of feasible intervals if F vanishes identically.
template <int Degree, class S>
std::vector<AlgebraicRoot> candidate_taus(const OwnedProblem<Degree, S>& problem) {
    const PowerPolynomial function = power_form(exact(problem.function.polynomial));
    if (!function.empty())
        return roots_in_unit_interval(function);
    std::vector<AlgebraicRoot> candidates{{{Rational(0), Rational(1)}, 0, 0}};
    for (const auto& constraint : problem.constraints)
        for (const auto& sides : demands_of(constraint))
            for (const PowerPolynomial& side : sides)
                for (const AlgebraicRoot& root : roots_in_unit_interval(side))
                    candidates.push_back(root);
    return candidates;
}

/// The first feasible tau of the given polynomials, as an interval narrower than 2^-80.
template <int Degree, class S>
std::optional<AlgebraicRoot> first_feasible_exactly(const OwnedProblem<Degree, S>& problem) {
    std::vector<AlgebraicRoot> candidates = candidate_taus(problem);
    for (AlgebraicRoot& root : candidates)
        root.narrow_to(Rational(0x1p-80));
    std::sort(candidates.begin(), candidates.end(),
              [](const AlgebraicRoot& a, const AlgebraicRoot& b) { return a.upper < b.upper; });
    for (const AlgebraicRoot& root : candidates)
        if (std::all_of(problem.constraints.begin(), problem.constraints.end(),
                        [&](const auto& constraint) { return holds_exactly_at(constraint, root); }))
            return root;
    return std::nullopt;
}

} // namespace chasles::test
