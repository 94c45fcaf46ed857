// `first_feasible` for polynomials that are known exactly: every case is decided, also touches and coincidences.
// Source: docs/derivations/12-exact-stage.md.
#pragma once

#include "chasles/algebra/exact_roots.h"
#include "chasles/algebra/first_feasible.h"

namespace chasles::algebra::detail {

/// Longer coefficients come from coordinates that differ by more than a hundred orders of magnitude, and cost seconds.
/// Those of ordinary scenes have 800 binary digits.
inline constexpr unsigned most_digits = 4096;

/// Takes the place of the search by clipping. Problems with longer coefficients are not looked at: the answer is then
/// all of [0, 1], and not certain. An error of F that is not zero asks for |F| <= error W: F is then known
/// no better than that, and what is found is not certain. Constraints must have no errors.
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

    std::optional<FeasibleInterval> run() const {
        if (is_too_long())
            return FeasibleInterval{0, 1, false};
        const bool vanishes = leading_sign(function_) == 0;
        std::optional<FeasibleInterval> first;
        std::optional<Dyadic> end; // of the interval that holds the first root found
        for (const Root& root : vanishes ? places_of_change() : Root::roots_of(function_)) {
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

    /// Roots of different polynomials that are closer than 2^-100 may be out of order. All of them are looked at.
    static constexpr int order_level = 100;

    /// Of two roots whose intervals may overlap.
    static FeasibleInterval earlier_of(const FeasibleInterval& a, const FeasibleInterval& b) {
        return {std::min(a.lower, b.lower), std::min(a.upper, b.upper), a.certain};
    }

    [[nodiscard]] bool is_too_long() const {
        const auto is_long = [](const Polynomial& p) {
            for (int i = 0; i <= Degree; ++i)
                if (p[i].digits() > most_digits)
                    return true;
            return false;
        };
        return is_long(function_) ||
               std::any_of(constraints_.begin(), constraints_.end(), [&](const OneConstraint& constraint) {
                   return is_long(constraint.first.polynomial) || is_long(constraint.second.polynomial);
               });
    }

    /// Where F vanishes all along, the first feasible tau is 0 or a root of a constraint.
    [[nodiscard]] std::vector<Root> places_of_change() const {
        std::vector<Root> places{Root::at(Dyadic())};
        const auto add = [&](const Polynomial& p) {
            if (leading_sign(p) != 0)
                for (Root& root : Root::roots_of(p))
                    places.push_back(std::move(root));
        };
        for (const OneConstraint& constraint : constraints_)
            all_demands(constraint, weight_, constraint.first.polynomial, constraint.second.polynomial,
                        [&](const Polynomial& first, const Polynomial* second) {
                            add(first);
                            if (second)
                                add(*second);
                            return true;
                        });
        for (Root& root : places)
            root.narrow_to(order_level);
        std::stable_sort(places.begin(), places.end(),
                         [](const Root& a, const Root& b) { return a.lower() < b.lower(); });
        return places;
    }

    /// Of a copy, since places out of order may lie before a root that is narrowed further.
    [[nodiscard]] bool holds_at(Root root) const {
        return std::all_of(constraints_.begin(), constraints_.end(),
                           [&](const OneConstraint& constraint) { return holds_at(root, constraint); });
    }

    [[nodiscard]] bool holds_at(Root& root, const OneConstraint& constraint) const {
        const Polynomial& first = constraint.first.polynomial;
        const Polynomial& second = constraint.second.polynomial;
        if (constraint.has_alternative && constraint.span && constraint.span->sign() == 0) // two signs tell it all
            return root.sign_of(first) * root.sign_of(second) <= 0;
        return all_demands(constraint, weight_, first, second, [&](const Polynomial& p, const Polynomial* q) {
            return root.sign_of(p) >= 0 || (q && root.sign_of(*q) >= 0);
        });
    }

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
