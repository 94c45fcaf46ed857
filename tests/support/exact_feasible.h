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

/// The error that first_feasible asks for: the rounding of `restricted`.
template <int Degree, class S>
algebra::Bounded<Degree, S> with_rounding(const Bernstein<Degree, S>& p) {
    const double largest = static_cast<double>(largest_coefficient(exact(p)));
    return {p, S(3 * Degree * algebra::unit_roundoff<S> * largest)};
}

/// The same problem in another scalar, over the weight 1, with the errors of that scalar's rounding.
template <class S, int Degree>
OwnedProblem<Degree, S> in_scalar(const OwnedProblem<Degree, Rational>& problem) {
    OwnedProblem<Degree, S> result;
    const auto rounded = [](const algebra::Bounded<Degree, Rational>& p) {
        return with_rounding(rounded_to<S>(p.polynomial));
    };
    result.function = rounded(problem.function);
    for (const auto& constraint : problem.constraints)
        result.constraints.push_back(
            {rounded(constraint.first), rounded(constraint.second), constraint.has_alternative});
    return result;
}

template <int Degree, class S>
bool holds_exactly_at(const algebra::Constraint<Degree, S>& constraint, const AlgebraicRoot& root) {
    return sign_at(power_form(exact(constraint.first.polynomial)), root) >= 0 ||
           (constraint.has_alternative && sign_at(power_form(exact(constraint.second.polynomial)), root) >= 0);
}

/// Where the first feasible tau can be: the roots of F, or the ends of feasible stretches if F vanishes identically.
template <int Degree, class S>
std::vector<AlgebraicRoot> candidate_taus(const OwnedProblem<Degree, S>& problem) {
    const PowerPolynomial function = power_form(exact(problem.function.polynomial));
    if (!function.empty())
        return roots_in_unit_interval(function);
    std::vector<AlgebraicRoot> candidates{{{Rational(0), Rational(1)}, 0, 0}};
    const auto add = [&](const Bernstein<Degree, S>& p) {
        const PowerPolynomial power = power_form(exact(p));
        for (const AlgebraicRoot& root : roots_in_unit_interval(power))
            candidates.push_back(root);
    };
    for (const auto& constraint : problem.constraints) {
        add(constraint.first.polynomial);
        if (constraint.has_alternative)
            add(constraint.second.polynomial);
    }
    return candidates;
}

/// The first feasible tau of the polynomials as they stand, within an interval narrower than 2^-80.
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
