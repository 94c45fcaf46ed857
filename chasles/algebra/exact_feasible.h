// `first_feasible` for polynomials with exact coefficients. It decides every case, also touches and coincidences.
// Source: docs/derivations/12-exact-stage.md.
#pragma once

#include "chasles/algebra/exact_roots.h"
#include "chasles/algebra/first_feasible.h"

namespace chasles::algebra::detail {

/// The search does not run for coefficients with more binary digits. They arise from coordinates that differ by more
/// than a hundred orders of magnitude and would cost seconds. Ordinary scenes have coefficients of 800 binary digits.
inline constexpr unsigned max_digits = 4096;

/// Replaces the search by clipping. If a coefficient is too long, the answer is [0, 1] and not certain. If F has an
/// error bound, the search finds the first tau with |F| <= error W, and its answer is not certain. Constraints must
/// have no errors.
template <int Degree>
class FeasibilitySearch<Degree, ExactNumber> {
public:
    using Polynomial = Bernstein<Degree, ExactNumber>;
    using Problem = FeasibilityProblem<Degree, ExactNumber>;
    using Root = ExactRoot<Degree>;

    FeasibilitySearch(const Problem& problem, const Tolerance& tolerance)
        : weight_(problem.weight), function_(problem.function.polynomial),
          constraints_(problem.constraints.begin(), problem.constraints.end()),
          level_(1 - std::ilogb(tolerance.width)) {
        const ExactNumber& error = problem.function.error;
        if (error.sign() == 0)
            return;
        is_exact_ = false;
        const Polynomial band = problem.weight * error;
        constraints_.push_back({{band + function_, {}}});
        constraints_.push_back({{band - function_, {}}});
        function_ = Polynomial();
    }

    /// The answer: tests the roots of F, or the candidates if F is zero, in ascending order.
    std::optional<FeasibleInterval> run() const {
        if (is_too_long())
            return FeasibleInterval{0, 1, false};
        const bool vanishes = leading_sign(function_) == 0;
        std::optional<FeasibleInterval> first;
        std::optional<Dyadic> end; // of the interval that contains the first feasible root
        for (const Root& root : vanishes ? candidate_roots() : Root::roots_of(function_)) {
            if (end && *end < root.lower())
                break;
            if (!holds_at(root))
                continue;
            const FeasibleInterval found = answer(root);
            first = first ? earlier_of(*first, found) : found;
            end = end ? std::min(*end, root.upper()) : root.upper();
        }
        return first;
    }

private:
    using OneConstraint = Constraint<Degree, ExactNumber>;

    /// Roots of different polynomials closer than 2^-100 may be out of order. `run` tests all of them.
    static constexpr int order_level = 100;

    /// The answer that covers the earlier of two roots whose intervals may overlap.
    static FeasibleInterval earlier_of(const FeasibleInterval& a, const FeasibleInterval& b) {
        return {std::min(a.lower, b.lower), std::min(a.upper, b.upper), a.certain};
    }

    /// Whether a coefficient has more digits than `max_digits`.
    [[nodiscard]] bool is_too_long() const {
        const auto is_long = [](const Polynomial& p) {
            for (int i = 0; i <= Degree; ++i)
                if (p[i].digits() > max_digits)
                    return true;
            return false;
        };
        return is_long(function_) ||
               std::any_of(constraints_.begin(), constraints_.end(), [&](const OneConstraint& constraint) {
                   return is_long(constraint.first.polynomial) || is_long(constraint.second.polynomial);
               });
    }

    /// The candidates if F is zero everywhere: then the first feasible tau is 0 or a root of a constraint.
    [[nodiscard]] std::vector<Root> candidate_roots() const {
        std::vector<Root> candidates{Root::at(Dyadic())};
        const auto add = [&](const Polynomial& p) {
            if (leading_sign(p) != 0)
                for (Root& root : Root::roots_of(p))
                    candidates.push_back(std::move(root));
        };
        for (const OneConstraint& constraint : constraints_)
            all_inequalities(constraint, weight_, constraint.first.polynomial, constraint.second.polynomial,
                             [&](const Polynomial& first, const Polynomial* second) {
                                 add(first);
                                 if (second)
                                     add(*second);
                                 return true;
                             });
        for (Root& root : candidates)
            root.narrow_to(order_level);
        std::stable_sort(candidates.begin(), candidates.end(),
                         [](const Root& a, const Root& b) { return a.lower() < b.lower(); });
        return candidates;
    }

    /// Whether all constraints hold at a root. Narrows a copy: roots out of order may lie before the narrowed root.
    [[nodiscard]] bool holds_at(Root root) const {
        return std::all_of(constraints_.begin(), constraints_.end(),
                           [&](const OneConstraint& constraint) { return holds_at(root, constraint); });
    }

    /// Whether one constraint holds at a root. Narrows the root as far as the signs need it.
    [[nodiscard]] bool holds_at(Root& root, const OneConstraint& constraint) const {
        const Polynomial& first = constraint.first.polynomial;
        const Polynomial& second = constraint.second.polynomial;
        if (constraint.has_alternative && constraint.span &&
            constraint.span->sign() == 0) // 0 lies between first and second
            return root.sign_of(first) * root.sign_of(second) <= 0;
        return all_inequalities(constraint, weight_, first, second, [&](const Polynomial& p, const Polynomial* q) {
            return root.sign_of(p) >= 0 || (q && root.sign_of(*q) >= 0);
        });
    }

    /// An interval around the root, rounded outward to doubles.
    [[nodiscard]] FeasibleInterval answer(Root root) const {
        root.narrow_to(level_);
        root.separate_from_zero();
        return {root.lower().rounded_down(), root.upper().rounded_up(), is_exact_};
    }

    Polynomial weight_;
    Polynomial function_;
    std::vector<OneConstraint> constraints_;
    int level_;
    bool is_exact_ = true;
};

} // namespace chasles::algebra::detail
