// The one question behind every elementary detection: the first tau in [0, 1] with F(tau) = 0 and all constraints
// satisfied, for polynomials whose coefficients are known to within a bound. Never misses, and stops at a tolerance.
// Source: T. Sederberg, T. Nishita, "Curve intersection using Bezier clipping", 1990; the bounds, the proof and the
// cost are in docs/derivations/06-first-feasible.md.
#pragma once

#include "chasles/algebra/crossing_guess.h"
#include "chasles/algebra/feasibility_problem.h"
#include "chasles/algebra/unit_roundoff.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace chasles::algebra {

namespace detail {

/// A part of [0, 1] that is still to be searched. Its ends are as fine as the scalar.
template <class Scalar>
struct Part {
    Scalar lower;
    Scalar upper;
    [[nodiscard]] Scalar width() const { return upper - lower; }
};

/// The nearest double on the safe side.
template <class Scalar>
double rounded_down(const Scalar& x) {
    const double nearest = static_cast<double>(x);
    return Scalar(nearest) > x ? std::nextafter(nearest, -1.0) : nearest;
}
template <class Scalar>
double rounded_up(const Scalar& x) {
    const double nearest = static_cast<double>(x);
    return Scalar(nearest) < x ? std::nextafter(nearest, 2.0) : nearest;
}

/// Fractions of a part that a clip leaves over; empty when lower > upper.
struct Clip {
    double lower = 0;
    double upper = 1;
};

/// A fraction rounded so that clipping never cuts off too much; also covers roundings of `part_of` below.
inline constexpr double clip_slack = 0x1p-50;

/// Where the hull of the points (i / Degree, high_i) may be >= 0. Everything outside is proven negative.
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
    using Interval = Part<Scalar>;

    FeasibilitySearch(const Problem& problem, const Tolerance& tolerance) : problem_(problem), tolerance_(tolerance) {}

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
    std::optional<FeasibleInterval> search() {
        std::array<Interval, depth_limit> later; // right halves, the earliest on top
        std::size_t waiting = 0;
        Interval part{Scalar(tolerance_.focus.lower), Scalar(tolerance_.focus.upper)};
        if (tolerance_.focus.upper < 1)
            later[waiting++] = {part.upper, Scalar(1)};
        for (;;) {
            const Look look = look_at(part);
            if (look.clip.lower > look.clip.upper) {
                if (waiting == 0)
                    return std::nullopt;
                part = later[--waiting];
                continue;
            }
            const Interval smaller = part_of(part, look.clip);
            const bool halves = smaller.width() > Scalar(0.5) * part.width();
            const bool out_of_steps = restrictions_ >= tolerance_.restrictions || waiting == later.size();
            if (const auto found = final_answer(smaller, is_finest(part), halves && look.is_undecidable, out_of_steps))
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
    /// A clip by F that leaves no more is followed by another one, without asking the constraints.
    static constexpr double good_clip = 0.25;

    /// What is proven of a part.
    enum class Decision : std::uint8_t {
        feasible,   ///< F changes sign and all constraints hold all along
        infeasible, ///< F changes sign and some constraint fails all along
        open
    };

    /// What one step learns of a part.
    struct Look {
        Clip clip;           ///< where F may vanish and every constraint may hold
        bool is_undecidable; ///< no smaller part can be told apart from this one
    };

    /// Where F seems to cross its band for the first time; not where it is about as flat as the band is wide.
    [[nodiscard]] std::optional<Interval> around_first_crossing() const {
        constexpr double spare = 1.25;
        constexpr double most_bend = 0.25;
        const Focus& focus = tolerance_.focus;
        const Polynomial& function = problem_.function.polynomial;
        const auto rounded = converted<double>(function);
        const auto guess =
            is_all(focus) ? first_crossing(rounded) : crossing_near(rounded, 0.5 * (focus.lower + focus.upper));
        if (!guess)
            return std::nullopt;
        const double weight = mix(double(problem_.weight[0]), double(problem_.weight[Degree]), guess->tau);
        double rim = spare * double(problem_.function.error) * weight / std::abs(guess->slope) +
                     4 * unit_roundoff<Scalar> * guess->tau;
        Scalar tau(guess->tau);
        if constexpr (unit_roundoff<Scalar> < unit_roundoff<double>) { // one more step
            const double move = double(value_at(function, tau)) / guess->slope;
            const double left = 0x1p-8 * std::abs(move);
            if (left > 0.25 * tolerance_.width) // the guess has not settled
                return std::nullopt;
            tau = tau - Scalar(move);
            rim += left;
        }
        if (!(rim * std::abs(guess->bend) < most_bend))
            return std::nullopt;
        const Interval around{std::max<Scalar>(Scalar(focus.lower), tau - Scalar(rim)),
                              std::min<Scalar>(Scalar(1), tau + Scalar(rim))};
        return around.lower < around.upper ? std::optional(around) : std::nullopt; // not where the step led outside
    }

    /// Feasible: the first root is in `around`. Infeasible: there is none anywhere.
    [[nodiscard]] Decision decide_first_crossing(const Interval& around) {
        View there(problem_, around, restrictions_);
        const Polynomial function = there(problem_.function.polynomial);
        if (!changes_sign(function, there.error_of(problem_.function)) ||
            !keeps_its_sign({Scalar(tolerance_.focus.lower), around.lower}, function[0]))
            return Decision::open;
        const Decision decision = decide(there, function);
        if (decision != Decision::infeasible ||
            keeps_its_sign({around.upper, Scalar(1)}, Scalar(Scalar(0) - function[Degree])))
            return decision;
        tolerance_.focus = {rounded_down(around.upper), 1};
        return Decision::open;
    }

    static bool is_all(const Focus& focus) { return focus.lower <= 0 && focus.upper >= 1; }

    /// Proven for F on a part. `towards_crossing` is F at the end where it is about to cross zero, as seen along tau
    /// or against it.
    [[nodiscard]] bool keeps_its_sign(const Interval& part, const Scalar& towards_crossing) {
        if (part.lower >= part.upper)
            return true;
        const Scalar rise = trend() * towards_crossing;
        if (rise + largest_band() < Scalar(0))
            return true;
        View there(problem_, part, restrictions_);
        return keeps_one_sign(there(problem_.function.polynomial), there.error_of(problem_.function));
    }

    /// 1 if F does not fall anywhere, -1 if it does not rise, otherwise 0.
    [[nodiscard]] Scalar trend() const {
        const Polynomial& p = problem_.function.polynomial;
        bool rises = true, falls = true;
        for (int i = 0; i < Degree; ++i) {
            rises = rises && !(p[i + 1] < p[i]);
            falls = falls && !(p[i] < p[i + 1]);
        }
        return Scalar(rises ? 1 : falls ? -1 : 0);
    }

    [[nodiscard]] Scalar largest_band() const {
        Scalar weight = problem_.weight[0];
        for (int i = 1; i <= Degree; ++i)
            weight = std::max<Scalar>(weight, problem_.weight[i]);
        return weight * problem_.function.error;
    }

    static Interval part_of(const Interval& part, const Clip& clip) {
        const Scalar slack = Scalar(2 * unit_roundoff<Scalar>) * part.upper;
        const Scalar lower = part.lower + Scalar(clip.lower) * part.width() - slack;
        const Scalar upper = part.lower + Scalar(clip.upper) * part.width() + slack;
        return {clip.lower <= 0 || lower < part.lower ? part.lower : lower,
                clip.upper >= 1 || upper > part.upper ? part.upper : upper};
    }

    /// The answer, if `part` is narrow enough, or if looking closer cannot tell more.
    [[nodiscard]] std::optional<FeasibleInterval> final_answer(const Interval& part, bool was_finest, bool undecidable,
                                                               bool out_of_steps) {
        if (!undecidable && !out_of_steps && part.width() > Scalar(0.5 * tolerance_.width))
            return std::nullopt;
        const Scalar rim = std::max<Scalar>(part.width(), Scalar(8 * unit_roundoff<Scalar>) * part.upper);
        const Interval wider{std::max<Scalar>(Scalar(0), part.lower - rim),
                             std::min<Scalar>(Scalar(1), part.upper + rim)};
        View there(problem_, wider, restrictions_);
        const Decision decision = decide(there, there(problem_.function.polynomial));
        if (decision == Decision::feasible) // and none is before `part`: the root is in it or in the rim above
            return FeasibleInterval{rounded_down(part.lower), rounded_up(wider.upper), true};
        if (undecidable) // F is as good as zero from the lower end on
            return uncertain({part.lower, std::min<Scalar>(part.upper, part.lower + Scalar(tolerance_.width))});
        return was_finest || out_of_steps ? std::optional(uncertain(part)) : std::nullopt;
    }

    /// A part that is too narrow to be halved. It is clipped once more before it counts as a contact.
    [[nodiscard]] bool is_finest(const Interval& part) const {
        return part.width() <= Scalar(tolerance_.resolution) ||
               part.width() <= Scalar(4 * unit_roundoff<Scalar>) * part.upper;
    }

    static FeasibleInterval uncertain(const Interval& part) {
        return {rounded_down(part.lower), rounded_up(part.upper), false};
    }

    /// The problem's polynomials on one part.
    class View {
    public:
        View(const Problem& problem, const Interval& part, int& count)
            : count_(count), is_whole_(part.lower == Scalar(0) && part.upper == Scalar(1)),
              restriction_(part.lower, part.upper), weight_((*this)(problem.weight)) {}

        [[nodiscard]] bool is_whole() const { return is_whole_; }
        Polynomial operator()(const Polynomial& p) {
            if (is_whole_)
                return p;
            ++count_;
            return restriction_(p);
        }
        [[nodiscard]] const Polynomial& weight() const { return weight_; }
        [[nodiscard]] Polynomial error_of(const Bounded<Degree, Scalar>& p) const { return weight_ * p.error; }
        /// Of the second polynomial, where there is one.
        Polynomial second_of(const Constraint<Degree, Scalar>& constraint) {
            return constraint.has_alternative ? (*this)(constraint.second.polynomial) : Polynomial();
        }

    private:
        int& count_;
        bool is_whole_;
        Restriction<Degree, Scalar> restriction_;
        Polynomial weight_;
    };

    /// Undecidable: F is within about its bound all along (twice, as clips are rounded outward), and every constraint
    /// either holds or is within its bound.
    [[nodiscard]] Look look_at(const Interval& part) {
        View on_part(problem_, part, restrictions_);
        const Polynomial function = on_part(problem_.function.polynomial);
        const Polynomial band = on_part.error_of(problem_.function);
        Look look{intersection(clip_to_nonnegative(band + function), clip_to_nonnegative(band - function)),
                  is_blurred(function, band * Scalar(2))};
        const bool is_well_clipped = look.clip.upper - look.clip.lower <= good_clip;
        if (is_well_clipped && !on_part.is_whole() && part.width() > Scalar(tolerance_.width))
            return look;
        for (const auto& constraint : problem_.constraints) {
            if (look.clip.lower > look.clip.upper)
                return look;
            clip_by(constraint, on_part, look);
        }
        return look;
    }

    /// Where there are alternatives, the larger of the two bounds counts.
    static void clip_by(const Constraint<Degree, Scalar>& constraint, View& on_part, Look& look) {
        const Polynomial first_error = on_part.error_of(constraint.first);
        const Polynomial second_error = on_part.error_of(constraint.second);
        const auto tells_no_more = [](const Polynomial& p, const Polynomial& error) {
            return is_blurred(p, error) || is_positive(p, error);
        };
        const auto clip = [&](const Polynomial& first, const Polynomial* second) {
            Polynomial bound = first + first_error;
            if (second)
                bound = Polynomial(maximum(bound.coefficients, (*second + second_error).coefficients));
            look.clip = intersection(look.clip, clip_to_nonnegative(bound));
            look.is_undecidable = look.is_undecidable && (tells_no_more(first, first_error) ||
                                                          (second && tells_no_more(*second, second_error)));
            return true;
        };
        all_demands(constraint, on_part.weight(), on_part(constraint.first.polynomial), on_part.second_of(constraint),
                    clip);
    }

    static bool is_blurred(const Polynomial& p, const Polynomial& error) {
        const auto size = magnitude(p.coefficients);
        for (int i = 0; i <= Degree; ++i)
            if (size[static_cast<std::size_t>(i)] > error[i])
                return false;
        return true;
    }

    [[nodiscard]] Decision decide(View& there, const Polynomial& function) {
        if (!changes_sign(function, there.error_of(problem_.function)))
            return Decision::open;
        Decision decision = Decision::feasible;
        for (const auto& constraint : problem_.constraints) {
            const Polynomial first_error = there.error_of(constraint.first);
            const Polynomial second_error = there.error_of(constraint.second);
            const auto may_hold = [&](const Polynomial& first, const Polynomial* second) {
                if (is_positive(first, first_error) || (second && is_positive(*second, second_error)))
                    return true;
                decision = Decision::open;
                return !is_negative(first, first_error) || (second && !is_negative(*second, second_error));
            };
            if (!all_demands(constraint, there.weight(), there(constraint.first.polynomial),
                             there.second_of(constraint), may_hold))
                return Decision::infeasible;
        }
        return decision;
    }

    static bool changes_sign(const Polynomial& function, const Polynomial& band) {
        const Scalar zero(0);
        const bool falls = function[0] > band[0] && Scalar(zero - function[Degree]) > band[Degree];
        const bool rises = Scalar(zero - function[0]) > band[0] && function[Degree] > band[Degree];
        return falls || rises;
    }

    const Problem& problem_;
    Tolerance tolerance_;
    int restrictions_ = 0; ///< so far
};

} // namespace detail

/// The first tau in [0, 1] where F may vanish and every constraint may hold. Empty: proven that there is none.
/// Otherwise nothing feasible lies before `lower`, and `upper - lower` is at most `tolerance.width` unless F or the
/// constraints graze zero by less than their error bounds. The errors must include the rounding of restriction
/// (`restriction_units` of the coefficient magnitudes), and with a span that of `span W - first` besides.
template <int Degree, class Scalar>
std::optional<FeasibleInterval> first_feasible(const FeasibilityProblem<Degree, Scalar>& problem,
                                               const Tolerance& tolerance) {
    return detail::FeasibilitySearch<Degree, Scalar>(problem, tolerance).run();
}

} // namespace chasles::algebra
