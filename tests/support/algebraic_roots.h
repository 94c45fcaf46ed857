// Real roots of rational polynomials in [0, 1] by Sturm's theorem, and exact signs of other polynomials at them.
// Source: textbooks of computer algebra. This header shares no code with chasles/algebra.
#pragma once

#include "tests/support/power_polynomial.h"

namespace chasles::test {

inline PowerPolynomial derivative(const PowerPolynomial& p) {
    PowerPolynomial result;
    for (std::size_t i = 1; i < p.size(); ++i)
        result.push_back(p[i] * Rational(static_cast<int>(i)));
    return result;
}

struct Division {
    PowerPolynomial quotient;
    PowerPolynomial remainder;
};

inline Division divided(PowerPolynomial a, const PowerPolynomial& b) {
    PowerPolynomial quotient(a.size() < b.size() ? 0 : a.size() - b.size() + 1, Rational(0));
    while (a.size() >= b.size()) {
        const Rational factor = a.back() / b.back();
        const std::size_t shift = a.size() - b.size();
        quotient[shift] = factor;
        for (std::size_t i = 0; i < b.size(); ++i)
            a[shift + i] -= factor * b[i];
        a = trimmed(a);
    }
    return {trimmed(quotient), a};
}

/// A positive multiple with small coefficients: integers without a common divisor.
inline PowerPolynomial shortened(const PowerPolynomial& p) {
    using Integer = boost::multiprecision::mpz_int;
    Integer multiple(1);
    Integer divisor(0);
    for (const Rational& c : p) {
        multiple = lcm(multiple, Integer(denominator(c)));
        divisor = gcd(divisor, Integer(numerator(c)));
    }
    return p.empty() ? p : scaled(p, Rational(multiple) / Rational(divisor));
}

inline PowerPolynomial common_divisor(PowerPolynomial a, PowerPolynomial b) {
    while (!b.empty()) {
        PowerPolynomial next = shortened(divided(a, b).remainder);
        a = std::move(b);
        b = std::move(next);
    }
    return a;
}

inline PowerPolynomial square_free(const PowerPolynomial& p) {
    return degree(p) < 1 ? p : shortened(divided(p, common_divisor(p, derivative(p))).quotient);
}

/// Counts the distinct roots of a square-free polynomial.
class SturmChain {
public:
    explicit SturmChain(const PowerPolynomial& p) : chain_{p, derivative(p)} {
        while (!chain_.back().empty())
            chain_.push_back(
                shortened(scaled(divided(chain_[chain_.size() - 2], chain_.back()).remainder, Rational(-1))));
        chain_.pop_back();
    }

    /// The number of roots in ]from, to].
    [[nodiscard]] int roots(const Rational& from, const Rational& to) const { return changes(from) - changes(to); }

private:
    [[nodiscard]] int changes(const Rational& tau) const {
        int count = 0;
        int last = 0;
        for (const PowerPolynomial& p : chain_) {
            const int sign = value(p, tau).sign();
            count += sign * last < 0 ? 1 : 0;
            last = sign != 0 ? sign : last;
        }
        return count;
    }

    std::vector<PowerPolynomial> chain_;
};

/// The only root of a square-free polynomial in ]lower, upper], or `upper` if lower and upper are equal.
struct AlgebraicRoot {
    PowerPolynomial polynomial;
    Rational lower;
    Rational upper;

    [[nodiscard]] bool is_point() const { return lower == upper; }

    void halve() {
        if (is_point())
            return;
        const Rational middle = (lower + upper) / 2;
        const int at_middle = value(polynomial, middle).sign();
        (at_middle == sign_above_lower() ? lower : upper) = middle;
        if (at_middle == 0)
            lower = middle;
    }
    void narrow_to(const Rational& width) {
        while (upper - lower > width)
            halve();
    }

private:
    /// The sign just above `lower`. The root is simple, and `lower` may be another root.
    [[nodiscard]] int sign_above_lower() const {
        const int at_lower = value(polynomial, lower).sign();
        return at_lower != 0 ? at_lower : value(derivative(polynomial), lower).sign();
    }
};

inline void isolate(const SturmChain& chain, AlgebraicRoot part, std::vector<AlgebraicRoot>& roots) {
    const int count = chain.roots(part.lower, part.upper);
    if (count == 0)
        return;
    if (count == 1) {
        roots.push_back(part);
        return;
    }
    const Rational middle = (part.lower + part.upper) / 2;
    isolate(chain, {part.polynomial, part.lower, middle}, roots);
    isolate(chain, {part.polynomial, middle, part.upper}, roots);
}

/// Distinct roots in [0, 1], in order. `p` must not be zero.
inline std::vector<AlgebraicRoot> roots_in_unit_interval(const PowerPolynomial& p) {
    const PowerPolynomial simple = square_free(p);
    std::vector<AlgebraicRoot> roots;
    if (degree(simple) < 1)
        return roots;
    if (value(simple, 0) == 0)
        roots.push_back({simple, 0, 0});
    isolate(SturmChain(simple), {simple, 0, 1}, roots);
    return roots;
}

/// The sign of p at the root, exactly.
inline int sign_at(const PowerPolynomial& p, AlgebraicRoot root) {
    if (p.empty() || root.is_point())
        return value(p, root.upper).sign();
    const PowerPolynomial shared = common_divisor(root.polynomial, p);
    if (degree(shared) > 0 && SturmChain(shared).roots(root.lower, root.upper) > 0)
        return 0;
    const SturmChain chain(square_free(p));
    while (!root.is_point() && chain.roots(root.lower, root.upper) > 0)
        root.halve();
    return value(p, root.upper).sign();
}

} // namespace chasles::test
