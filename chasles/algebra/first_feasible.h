// The solver behind every elementary test: the first tau in [0, 1] with F(tau) = 0 and all constraints satisfied.
// Coefficients are known to within error bounds. The search misses no feasible tau and stops at a given tolerance.
// Source: T. Sederberg, T. Nishita, "Curve intersection using Bezier clipping", 1990. The bounds, the proof and the
// cost are in docs/derivations/06-first-feasible.md.
#pragma once

#include "chasles/algebra/bezier_clip.h"
#include "chasles/algebra/crossing_guess.h"
#include "chasles/algebra/feasibility_problem.h"

#include <cstdint>

namespace chasles::algebra {

namespace detail {

/// The search for one problem. It first tries an interval around a guessed crossing and falls back to clipping and
/// halving. Every part is restricted from the given coefficients, therefore rounding errors do not accumulate.
template <int Degree, class Scalar>
class FeasibilitySearch {
public:
    using Polynomial = Bernstein<Degree, Scalar>;
    using Problem = FeasibilityProblem<Degree, Scalar>;
    using Interval = Subinterval<Scalar>;

    FeasibilitySearch(const Problem& problem, const Tolerance& tolerance) : problem_(problem), tolerance_(tolerance) {}

    /// The answer of `first_feasible`.
    std::optional<FeasibleInterval> run() {
        if (const auto around = around_first_crossing()) {
            switch (decide_first_crossing(*around)) {
            case Decision::feasible:
                return FeasibleInterval{rounded_down(around->lower), rounded_up(around->upper), true};
            case Decision::infeasible:
                return std::nullopt;
            case Decision::open:
                restrictions_ = 0;
            }
        }
        return search();
    }

private:
    /// Clips and halves, always the earliest part first, until a part is answered or all parts are excluded.
    std::optional<FeasibleInterval> search() {
        std::array<Interval, depth_limit> later; // a stack of right halves; the earliest half is on top
        std::size_t waiting = 0;
        Interval part{Scalar(tolerance_.focus.lower), Scalar(tolerance_.focus.upper)};
        if (tolerance_.focus.upper < 1)
            later[waiting++] = {part.upper, Scalar(1)};
        for (;;) {
            const PartBounds bounds = bounds_on(part);
            if (bounds.clip.is_empty()) {
                if (waiting == 0)
                    return std::nullopt;
                part = later[--waiting];
                continue;
            }
            // Clips that remove less than half are slow to converge. Halving separates several roots.
            const Interval smaller = clipped(part, bounds.clip);
            const bool halves = smaller.width() > Scalar(0.5) * part.width();
            const bool out_of_steps = restrictions_ >= tolerance_.restrictions || waiting == later.size();
            const Stop stop{is_finest(part), halves && bounds.is_undecidable, out_of_steps};
            if (const auto found = final_answer(smaller, stop))
                return found;
            part = smaller;
            if (halves) {
                const Scalar middle = smaller.lower + Scalar(0.5) * smaller.width();
                later[waiting++] = {middle, smaller.upper};
                part.upper = middle;
            }
        }
    }

    static constexpr std::size_t depth_limit = 120;
    /// If a clip by F leaves at most this fraction of a part, the next clip is by F alone, without the constraints.
    static constexpr double good_clip = 0.25;

    /// The proven state of a part.
    enum class Decision : std::uint8_t {
        feasible,   ///< F changes sign, and all constraints hold on the whole part
        infeasible, ///< F changes sign, and some constraint fails on the whole part
        open        ///< neither is proven
    };

    /// The result of one step on a part.
    struct PartBounds {
        Clip clip;           ///< where F may vanish and every constraint may hold
        bool is_undecidable; ///< the error bounds hide any difference between this part and a smaller one
    };

    /// Reasons to stop at a part.
    struct Stop {
        bool was_finest;     ///< the part was too narrow to be halved before its last clip
        bool is_undecidable; ///< smaller parts give no more information
        bool is_out_of_steps;
    };

    /// A point next to a guessed crossing. F is expected to cross its error band within `radius` of the point.
    struct Neighbourhood {
        Scalar tau;
        double radius;
    };

    /// An approximate first root of F, or, with a focus, the root that the iteration finds from the middle of the
    /// focus.
    [[nodiscard]] std::optional<Crossing> guessed_crossing() const {
        const Focus& focus = tolerance_.focus;
        const auto rounded = converted<double>(problem_.function.polynomial);
        return is_all(focus) ? first_crossing(rounded) : crossing_near(rounded, 0.5 * (focus.lower + focus.upper));
    }

    /// Scalars beyond double refine the guess by one Newton step. The result is empty if that step is too long.
    [[nodiscard]] std::optional<Neighbourhood> neighbourhood_of(const Crossing& guess) const {
        constexpr double spare = 1.25; // for the curvature of F (note 06, "Guess")
        const double weight = mix(double(problem_.weight[0]), double(problem_.weight[Degree]), guess.tau);
        Neighbourhood result{Scalar(guess.tau),
                             spare * double(problem_.function.error) * weight / std::abs(guess.slope) +
                                 4 * unit_roundoff<Scalar> * guess.tau};
        if constexpr (unit_roundoff<Scalar> < unit_roundoff<double>) {
            const double move = double(value_at(problem_.function.polynomial, result.tau)) / guess.slope;
            const double remainder = 0x1p-8 * std::abs(move);
            if (remainder > 0.25 * tolerance_.width) // the guess has not converged
                return std::nullopt;
            result.tau = result.tau - Scalar(move);
            result.radius += remainder;
        }
        return result;
    }

    /// An interval in which F seems to cross its error band for the first time. The result is empty without a usable
    /// guess and where F is so curved that its slope changes much within the band.
    [[nodiscard]] std::optional<Interval> around_first_crossing() const {
        constexpr double max_slope_change = 0.25;
        const auto guess = guessed_crossing();
        if (!guess)
            return std::nullopt;
        const auto near = neighbourhood_of(*guess);
        if (!near || !(near->radius * std::abs(guess->curvature) < max_slope_change))
            return std::nullopt;
        const Interval around{std::max<Scalar>(Scalar(tolerance_.focus.lower), near->tau - Scalar(near->radius)),
                              std::min<Scalar>(Scalar(1), near->tau + Scalar(near->radius))};
        return around.lower < around.upper ? std::optional(around) : std::nullopt; // empty if tau left the focus
    }

    /// Feasible: `around` contains the first feasible root. Infeasible: no root is feasible. If only the crossing in
    /// `around` is infeasible, the focus moves to the rest of [0, 1].
    [[nodiscard]] Decision decide_first_crossing(const Interval& around) {
        RestrictedProblem local(problem_, around, restrictions_);
        const Polynomial function = local(problem_.function.polynomial);
        if (!changes_sign(function, local.error_of(problem_.function)) ||
            !keeps_its_sign({Scalar(tolerance_.focus.lower), around.lower}, function[0]))
            return Decision::open;
        const Decision decision = decide(local, function);
        if (decision != Decision::infeasible ||
            keeps_its_sign({around.upper, Scalar(1)}, Scalar(Scalar(0) - function[Degree])))
            return decision;
        tolerance_.focus = {rounded_down(around.upper), 1};
        return Decision::open;
    }

    /// Whether the focus is the whole of [0, 1].
    static bool is_all(const Focus& focus) { return focus.lower <= 0 && focus.upper >= 1; }

    /// Whether F is proven to keep its sign on a part next to the crossing. `end_value` is F at the end of the crossing
    /// interval that touches the part; its sign is reversed for a part after the crossing. For a monotonic F this value
    /// decides.
    [[nodiscard]] bool keeps_its_sign(const Interval& part, const Scalar& end_value) {
        if (part.lower >= part.upper)
            return true;
        const Scalar rise = trend() * end_value;
        if (rise + largest_band() < Scalar(0))
            return true;
        RestrictedProblem local(problem_, part, restrictions_);
        return keeps_one_sign(local(problem_.function.polynomial), local.error_of(problem_.function));
    }

    /// 1 if F falls nowhere, -1 if F rises nowhere, otherwise 0.
    [[nodiscard]] Scalar trend() const {
        const Polynomial& p = problem_.function.polynomial;
        bool rises = true, falls = true;
        for (int i = 0; i < Degree; ++i) {
            rises = rises && !(p[i + 1] < p[i]);
            falls = falls && !(p[i] < p[i + 1]);
        }
        return Scalar(rises ? 1 : falls ? -1 : 0);
    }

    /// The greatest error of a coefficient of F.
    [[nodiscard]] Scalar largest_band() const {
        Scalar weight = problem_.weight[0];
        for (int i = 1; i <= Degree; ++i)
            weight = std::max<Scalar>(weight, problem_.weight[i]);
        return weight * problem_.function.error;
    }

    /// The answer of the search, if `part` is narrow enough or the search has a reason to stop.
    [[nodiscard]] std::optional<FeasibleInterval> final_answer(const Interval& part, const Stop& stop) {
        if (!stop.is_undecidable && !stop.is_out_of_steps && part.width() > Scalar(0.5 * tolerance_.width))
            return std::nullopt;
        const Scalar rim = std::max<Scalar>(part.width(), Scalar(8 * unit_roundoff<Scalar>) * part.upper);
        const Interval wider{std::max<Scalar>(Scalar(0), part.lower - rim),
                             std::min<Scalar>(Scalar(1), part.upper + rim)};
        RestrictedProblem local(problem_, wider, restrictions_);
        const Decision decision = decide(local, local(problem_.function.polynomial));
        if (decision == Decision::feasible) // no root lies before `part`, so the root is in `part` or in the upper rim
            return FeasibleInterval{rounded_down(part.lower), rounded_up(wider.upper), true};
        if (stop.is_undecidable) // F is within its error bound from the lower end on
            return uncertain({part.lower, std::min<Scalar>(part.upper, part.lower + Scalar(tolerance_.width))});
        return stop.was_finest || stop.is_out_of_steps ? std::optional(uncertain(part)) : std::nullopt;
    }

    /// Whether a part is too narrow to be halved. The search clips it once more before it reports a contact.
    [[nodiscard]] bool is_finest(const Interval& part) const {
        return part.width() <= Scalar(tolerance_.resolution) ||
               part.width() <= Scalar(4 * unit_roundoff<Scalar>) * part.upper;
    }

    /// An answer without a proven root: no feasible tau lies before its lower end.
    static FeasibleInterval uncertain(const Interval& part) {
        return {rounded_down(part.lower), rounded_up(part.upper), false};
    }

    /// The polynomials of the problem on one part. It counts the restrictions.
    class RestrictedProblem {
    public:
        RestrictedProblem(const Problem& problem, const Interval& part, int& count)
            : count_(count), is_whole_(part.lower == Scalar(0) && part.upper == Scalar(1)),
              restriction_(part.lower, part.upper), weight_((*this)(problem.weight)) {}

        [[nodiscard]] bool is_whole() const { return is_whole_; }
        /// A polynomial of the problem on the part.
        Polynomial operator()(const Polynomial& p) {
            if (is_whole_)
                return p;
            ++count_;
            return restriction_(p);
        }
        /// The weight on the part.
        [[nodiscard]] const Polynomial& weight() const { return weight_; }
        /// The error bounds of the coefficients on the part.
        [[nodiscard]] Polynomial error_of(const Bounded<Degree, Scalar>& p) const { return weight_ * p.error; }
        /// The second polynomial of a constraint, or zero for a constraint without an alternative.
        Polynomial second_of(const Constraint<Degree, Scalar>& constraint) {
            return constraint.has_alternative ? (*this)(constraint.second.polynomial) : Polynomial();
        }

    private:
        int& count_;
        bool is_whole_;
        Restriction<Degree, Scalar> restriction_;
        Polynomial weight_;
    };

    /// A part is undecidable if F is within twice its error bound on the whole part and every constraint either holds
    /// or is within its error bound. The factor two covers the outward rounding of clips.
    [[nodiscard]] PartBounds bounds_on(const Interval& part) {
        RestrictedProblem local(problem_, part, restrictions_);
        const Polynomial function = local(problem_.function.polynomial);
        const Polynomial band = local.error_of(problem_.function);
        PartBounds bounds{intersection(clip_to_nonnegative(band + function), clip_to_nonnegative(band - function)),
                          is_within_error(function, band * Scalar(2))};
        const bool is_well_clipped = bounds.clip.upper - bounds.clip.lower <= good_clip;
        if (is_well_clipped && !local.is_whole() && part.width() > Scalar(tolerance_.width))
            return bounds;
        for (const auto& constraint : problem_.constraints) {
            if (bounds.clip.is_empty())
                return bounds;
            clip_by(constraint, local, bounds);
        }
        return bounds;
    }

    /// Clips by one constraint. With an alternative, the upper bound is the maximum of both upper bounds.
    static void clip_by(const Constraint<Degree, Scalar>& constraint, RestrictedProblem& local, PartBounds& bounds) {
        const Polynomial first_error = local.error_of(constraint.first);
        const Polynomial second_error = local.error_of(constraint.second);
        const auto is_settled = [](const Polynomial& p, const Polynomial& error) {
            return is_within_error(p, error) || is_positive(p, error);
        };
        const auto clip = [&](const Polynomial& first, const Polynomial* second) {
            Polynomial bound = first + first_error;
            if (second)
                bound = Polynomial(maximum(bound.coefficients, (*second + second_error).coefficients));
            bounds.clip = intersection(bounds.clip, clip_to_nonnegative(bound));
            bounds.is_undecidable = bounds.is_undecidable &&
                                    (is_settled(first, first_error) || (second && is_settled(*second, second_error)));
            return true;
        };
        all_inequalities(constraint, local.weight(), local(constraint.first.polynomial), local.second_of(constraint),
                         clip);
    }

    /// Whether every coefficient is within its error bound.
    static bool is_within_error(const Polynomial& p, const Polynomial& error) {
        const auto size = magnitude(p.coefficients);
        for (int i = 0; i <= Degree; ++i)
            if (size[static_cast<std::size_t>(i)] > error[i])
                return false;
        return true;
    }

    /// Decides a part from the signs of F at both ends and of all constraints.
    [[nodiscard]] Decision decide(RestrictedProblem& local, const Polynomial& function) {
        if (!changes_sign(function, local.error_of(problem_.function)))
            return Decision::open;
        Decision decision = Decision::feasible;
        for (const auto& constraint : problem_.constraints) {
            const Polynomial first_error = local.error_of(constraint.first);
            const Polynomial second_error = local.error_of(constraint.second);
            const auto may_hold = [&](const Polynomial& first, const Polynomial* second) {
                if (is_positive(first, first_error) || (second && is_positive(*second, second_error)))
                    return true;
                decision = Decision::open;
                return !is_negative(first, first_error) || (second && !is_negative(*second, second_error));
            };
            if (!all_inequalities(constraint, local.weight(), local(constraint.first.polynomial),
                                  local.second_of(constraint), may_hold))
                return Decision::infeasible;
        }
        return decision;
    }

    /// Whether F is proven to have opposite signs at both ends.
    static bool changes_sign(const Polynomial& function, const Polynomial& band) {
        const Scalar zero(0);
        const bool falls = function[0] > band[0] && Scalar(zero - function[Degree]) > band[Degree];
        const bool rises = Scalar(zero - function[0]) > band[0] && function[Degree] > band[Degree];
        return falls || rises;
    }

    const Problem& problem_;
    Tolerance tolerance_;
    int restrictions_ = 0; ///< number of restrictions done
};

} // namespace detail

/// The first tau in [0, 1] where F may vanish and every constraint may hold. An empty result proves that no such tau
/// exists. Otherwise no feasible tau lies before `lower`. The width `upper - lower` is at most `tolerance.width` unless
/// F or a constraint stays within its error bound of zero. The errors must include the rounding of restriction
/// (`restriction_units` unit roundoffs of the coefficient magnitudes); with a span, also the rounding of
/// `span W - first`.
template <int Degree, class Scalar>
std::optional<FeasibleInterval> first_feasible(const FeasibilityProblem<Degree, Scalar>& problem,
                                               const Tolerance& tolerance) {
    return detail::FeasibilitySearch<Degree, Scalar>(problem, tolerance).run();
}

} // namespace chasles::algebra
