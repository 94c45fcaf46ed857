// Roots in [0, 1] of polynomials with exact coefficients, and the signs of other polynomials at these roots.
// Source: G. Collins, A. Akritas, "Polynomial real root isolation using Descartes' rule of signs", 1976, applied to the
// Bernstein form; docs/derivations/12-exact-stage.md.
#pragma once

#include "chasles/algebra/exact_power_form.h"

#include <optional>

namespace chasles::algebra {

/// The number of sign changes between consecutive non-zero coefficients. It exceeds the number of roots in ]0, 1[ by an
/// even number, which may be 0 (Descartes' rule of signs).
template <int Degree>
int sign_changes(const Bernstein<Degree, ExactNumber>& p) {
    int changes = 0;
    int last = 0;
    for (int i = 0; i <= Degree; ++i) {
        const int sign = p[i].sign();
        changes += sign * last < 0 ? 1 : 0;
        last = sign != 0 ? sign : last;
    }
    return changes;
}

/// The sign of the first coefficient that is not zero; 0 for the zero polynomial. Without sign changes the polynomial
/// has this sign on ]0, 1[.
template <int Degree>
int leading_sign(const Bernstein<Degree, ExactNumber>& p) {
    for (int i = 0; i <= Degree; ++i)
        if (p[i].sign() != 0)
            return p[i].sign();
    return 0;
}

/// One polynomial on both halves of [0, 1], each mapped to [0, 1].
template <int Degree>
struct Halves {
    Bernstein<Degree, ExactNumber> left;
    Bernstein<Degree, ExactNumber> right;
};

/// The polynomial on [0, 1/2] and on [1/2, 1], by de Casteljau's algorithm.
template <int Degree>
Halves<Degree> halves(const Bernstein<Degree, ExactNumber>& p) {
    std::array<ExactNumber, Degree + 1> c;
    for (int i = 0; i <= Degree; ++i)
        c[i] = p[i];
    Halves<Degree> result;
    for (int length = Degree; length >= 0; --length) {
        result.left.set(Degree - length, c[0]);
        result.right.set(length, c[length]);
        for (int i = 0; i < length; ++i)
            c[i] = (c[i] + c[i + 1]).times_power_of_two(-1);
    }
    return result;
}

/// A number in [0, 1]. It is either a dyadic number (a point) or the only root of a polynomial in an open dyadic
/// interval, where the root is simple.
template <int Degree>
class ExactRoot {
public:
    using Polynomial = Bernstein<Degree, ExactNumber>;

    /// The distinct roots of p in [0, 1] in ascending order. p must not be zero.
    static std::vector<ExactRoot> roots_of(const Polynomial& p) {
        if (auto roots = isolated(p, multiple_level))
            return std::move(*roots);
        // Simple roots are always separated. NOLINTNEXTLINE(bugprone-unchecked-optional-access)
        return *isolated(bernstein_form<Degree>(without_multiple_roots(power_form(p))), no_limit);
    }
    static ExactRoot at(const Dyadic& point) { return {point, 0}; }

    [[nodiscard]] Dyadic lower() const { return lower_; }
    [[nodiscard]] Dyadic upper() const { return part_ ? lower_ + Dyadic(1.0).times_power_of_two(-level_) : lower_; }
    [[nodiscard]] bool is_point() const { return !part_; }

    /// Narrows the interval to a width of 2^-level.
    void narrow_to(int level) {
        while (part_ && level_ < level)
            halve();
    }
    /// Narrows the interval until its lower end is positive.
    void separate_from_zero() {
        while (part_ && lower_.sign() == 0)
            halve();
    }

    /// The sign of p at the root. Narrows the interval as far as the decision needs it.
    int sign_of(const Polynomial& p) {
        for (bool is_distinct = false; part_; narrow_to(level_ + 8)) {
            const Polynomial p_here = restricted(p, ExactNumber(lower()), ExactNumber(upper()));
            if (sign_changes(p_here) == 0)
                return leading_sign(p_here);
            if (level_ < suspect_level || is_distinct)
                continue;
            if (is_root_of(p_here))
                return 0;
            is_distinct = true;
        }
        return value_at(p, ExactNumber(lower_)).sign();
    }

private:
    /// Roots that are not separated at this level, at a width of 2^-40, probably form one multiple root.
    static constexpr int multiple_level = 40;
    /// If p still changes sign at this level, at a width of 2^-64, the root is probably also a root of p.
    static constexpr int suspect_level = 64;
    static constexpr int no_limit = 1 << 20;

    ExactRoot(Dyadic lower, int level, std::optional<Polynomial> part = {})
        : part_(std::move(part)), lower_(std::move(lower)), level_(level) {}

    /// The polynomial on the interval. Only for an interval.
    [[nodiscard]] const Polynomial& polynomial() const { return *part_; } // NOLINT(bugprone-unchecked-optional-access)
    [[nodiscard]] Dyadic middle() const { return lower_ + Dyadic(1.0).times_power_of_two(-level_ - 1); }

    /// Keeps the half with the root. The root becomes a point if it is the middle.
    void halve() {
        const auto [left, right] = halves(polynomial());
        if (sign_changes(left) == 0)
            lower_ = middle();
        ++level_;
        if (left[Degree].sign() == 0)
            part_.reset();
        else
            part_ = sign_changes(left) == 0 ? right : left;
    }

    /// Whether p has the same root; `p_here` is p on the interval. A common divisor has exactly this root there, or
    /// none.
    [[nodiscard]] bool is_root_of(const Polynomial& p_here) const {
        const PowerForm shared = common_divisor(power_form(polynomial()), power_form(p_here));
        return sign_changes(bernstein_form<Degree>(shared)) % 2 != 0;
    }

    /// The roots of p in [0, 1]. Empty if some roots are not separated at the deepest level.
    static std::optional<std::vector<ExactRoot>> isolated(const Polynomial& p, int deepest) {
        std::vector<ExactRoot> roots;
        if (p[0].sign() == 0)
            roots.push_back(at(Dyadic()));
        std::vector<ExactRoot> parts{{Dyadic(), 0, p}}; // half-open, with the upper end; the earliest part is on top
        while (!parts.empty()) {
            const ExactRoot part = std::move(parts.back());
            parts.pop_back();
            const int changes = sign_changes(part.polynomial());
            if (changes <= 1) {
                if (changes == 1)
                    roots.push_back(part);
                if (part.polynomial()[Degree].sign() == 0)
                    roots.push_back(at(part.upper()));
                continue;
            }
            if (part.level_ >= deepest)
                return std::nullopt;
            const auto [left, right] = halves(part.polynomial());
            parts.push_back({part.middle(), part.level_ + 1, right});
            parts.push_back({part.lower_, part.level_ + 1, left});
        }
        return roots;
    }

    std::optional<Polynomial> part_; ///< the polynomial on [lower, lower + 2^-level]; empty if `lower` is the root
    Dyadic lower_;
    int level_;
};

} // namespace chasles::algebra
