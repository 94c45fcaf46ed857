// Roots in [0, 1] of polynomials that are known exactly, and the signs of other polynomials at them.
// Source: G. Collins, A. Akritas, "Polynomial real root isolation using Descartes' rule of signs", 1976, here in
// Bernstein form; docs/derivations/12-exact-stage.md.
#pragma once

#include "chasles/algebra/exact_power_form.h"

#include <optional>

namespace chasles::algebra {

/// Sign changes among the coefficients, zeros left out: as many as roots in ]0, 1[, or more by an even number.
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

/// The sign of the first coefficient that is not zero; 0 for the zero polynomial. Without sign changes, it is the sign
/// all over ]0, 1[.
template <int Degree>
int leading_sign(const Bernstein<Degree, ExactNumber>& p) {
    for (int i = 0; i <= Degree; ++i)
        if (p[i].sign() != 0)
            return p[i].sign();
    return 0;
}

template <int Degree>
struct Halves {
    Bernstein<Degree, ExactNumber> left;
    Bernstein<Degree, ExactNumber> right;
};

/// The polynomial on [0, 1/2] and on [1/2, 1] (de Casteljau).
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

/// A number in [0, 1]: a multiple of a power of two, or the only root of a polynomial in an open interval, a simple
/// one.
template <int Degree>
class ExactRoot {
public:
    using Polynomial = Bernstein<Degree, ExactNumber>;

    /// The roots of p in [0, 1], in order, each of them once. p must not be zero.
    static std::vector<ExactRoot> roots_of(const Polynomial& p) {
        if (auto roots = isolated(p, multiple_level))
            return std::move(*roots);
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
    /// Narrows the interval until it is away from 0.
    void separate_from_zero() {
        while (part_ && lower_.sign() == 0)
            halve();
    }

    /// The sign of p at the root. Narrows the interval where that helps to tell.
    int sign_of(const Polynomial& p) {
        for (bool is_apart = false; part_; narrow_to(level_ + 8)) {
            const Polynomial p_here = restricted(p, ExactNumber(lower()), ExactNumber(upper()));
            if (sign_changes(p_here) == 0)
                return leading_sign(p_here);
            if (level_ < doubtful_level || is_apart)
                continue;
            if (is_root_of(p_here))
                return 0;
            is_apart = true;
        }
        return value_at(p, ExactNumber(lower_)).sign();
    }

private:
    /// Roots that bisection does not separate down to this width are likely one.
    static constexpr int multiple_level = 40;
    /// A number that is this close to a root of another polynomial is likely one.
    static constexpr int doubtful_level = 64;
    static constexpr int no_limit = 1 << 20;

    ExactRoot(Dyadic lower, int level, std::optional<Polynomial> part = {})
        : part_(std::move(part)), lower_(std::move(lower)), level_(level) {}

    [[nodiscard]] Dyadic middle() const { return lower_ + Dyadic(1.0).times_power_of_two(-level_ - 1); }

    void halve() {
        const auto [left, right] = halves(*part_);
        if (sign_changes(left) == 0)
            lower_ = middle();
        ++level_;
        if (left[Degree].sign() == 0)
            part_.reset();
        else
            part_ = sign_changes(left) == 0 ? right : left;
    }

    /// Both polynomials on the interval, where a common divisor has the same root or none.
    [[nodiscard]] bool is_root_of(const Polynomial& p_here) const {
        const PowerForm shared = common_divisor(power_form(*part_), power_form(p_here));
        return sign_changes(bernstein_form<Degree>(shared)) % 2 != 0;
    }

    /// Nothing if roots are still together at the deepest level.
    static std::optional<std::vector<ExactRoot>> isolated(const Polynomial& p, int deepest) {
        std::vector<ExactRoot> roots;
        if (p[0].sign() == 0)
            roots.push_back(at(Dyadic()));
        std::vector<ExactRoot> parts{{Dyadic(), 0, p}}; // half open: with the upper end; the earliest on top
        while (!parts.empty()) {
            const ExactRoot part = std::move(parts.back());
            parts.pop_back();
            const int changes = sign_changes(*part.part_);
            if (changes <= 1) {
                if (changes == 1)
                    roots.push_back(part);
                if ((*part.part_)[Degree].sign() == 0)
                    roots.push_back(at(part.upper()));
                continue;
            }
            if (part.level_ >= deepest)
                return std::nullopt;
            const auto [left, right] = halves(*part.part_);
            parts.push_back({part.middle(), part.level_ + 1, right});
            parts.push_back({part.lower_, part.level_ + 1, left});
        }
        return roots;
    }

    std::optional<Polynomial> part_; ///< the polynomial on [lower, lower + 2^-level]; none if `lower` is the root
    Dyadic lower_;
    int level_;
};

} // namespace chasles::algebra
