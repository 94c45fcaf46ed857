// The one question behind every elementary detection: the first tau in [0, 1] with F(tau) = 0 and all constraints
// satisfied, for polynomials whose coefficients are known to within a bound. Never misses, and stops at a tolerance.
// Source: T. Sederberg, T. Nishita, "Curve intersection using Bezier clipping", 1990; the bounds, the proof and the
// cost are in docs/derivations/06-first-feasible.md.
#pragma once

#include "chasles/algebra/bernstein.h"
#include "chasles/algebra/unit_roundoff.h"

#include <algorithm>
#include <cmath>
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

private:
    static constexpr std::size_t depth_limit = 120;
    /// A clip by F that leaves no more is followed by another one, without asking the constraints.
    static constexpr double good_clip = 0.25;

    /// What one step learns of a part.
    struct Look {
        Clip clip;           ///< where F may vanish and every constraint may hold
        bool is_undecidable; ///< no smaller part can be told apart from this one
    };

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
        if (is_certain(wider)) // what lies before `part` was excluded: the root is in it or in the rim above
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

    /// F changes sign and all constraints hold for certain.
    [[nodiscard]] bool is_certain(const Interval& wider) {
        View there(problem_, wider, restrictions_);
        const Polynomial function = there(problem_.function.polynomial);
        const Polynomial band = there.error_of(problem_.function);
        const bool falls = function[0] > band[0] && Scalar(Scalar(0) - function[Degree]) > band[Degree];
        const bool rises = Scalar(Scalar(0) - function[0]) > band[0] && function[Degree] > band[Degree];
        if (!falls && !rises)
            return false;
        return std::all_of(problem_.constraints.begin(), problem_.constraints.end(), [&](const auto& constraint) {
            const auto holds = [&](const Polynomial& first, const Polynomial* second) {
                return is_positive(first, there.error_of(constraint.first)) ||
                       (second && is_positive(*second, there.error_of(constraint.second)));
            };
            return all_demands(constraint, there.weight(), there(constraint.first.polynomial),
                               there.second_of(constraint), holds);
        });
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
