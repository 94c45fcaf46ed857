// Polynomials in the power basis with rational coefficients: the textbook form for comparison with Bernstein forms.
#pragma once

#include "tests/support/rational.h"

#include <vector>

namespace chasles::test {

/// Coefficients of 1, tau, tau^2, ...; no trailing zeros, empty for zero.
using PowerPolynomial = std::vector<Rational>;

inline PowerPolynomial trimmed(PowerPolynomial p) {
    while (!p.empty() && p.back() == 0)
        p.pop_back();
    return p;
}

inline int degree(const PowerPolynomial& p) {
    return static_cast<int>(p.size()) - 1;
}

inline Rational value(const PowerPolynomial& p, const Rational& tau) {
    Rational result(0);
    for (auto c = p.rbegin(); c != p.rend(); ++c)
        result = result * tau + *c;
    return result;
}

inline PowerPolynomial sum(const PowerPolynomial& a, const PowerPolynomial& b) {
    PowerPolynomial result(std::max(a.size(), b.size()), Rational(0));
    for (std::size_t i = 0; i < result.size(); ++i)
        result[i] = (i < a.size() ? a[i] : Rational(0)) + (i < b.size() ? b[i] : Rational(0));
    return trimmed(result);
}

inline PowerPolynomial multiplied(const PowerPolynomial& a, const PowerPolynomial& b) {
    if (a.empty() || b.empty())
        return {};
    PowerPolynomial result(a.size() + b.size() - 1, Rational(0));
    for (std::size_t i = 0; i < a.size(); ++i)
        for (std::size_t j = 0; j < b.size(); ++j)
            result[i + j] += a[i] * b[j];
    return trimmed(result);
}

inline PowerPolynomial scaled(const PowerPolynomial& a, const Rational& factor) {
    return multiplied(a, trimmed({factor}));
}

/// p(q(tau)).
inline PowerPolynomial composed(const PowerPolynomial& p, const PowerPolynomial& q) {
    PowerPolynomial result;
    for (auto c = p.rbegin(); c != p.rend(); ++c)
        result = sum(multiplied(result, q), trimmed({*c}));
    return result;
}

/// leading * product of (tau - root).
inline PowerPolynomial from_roots(const std::vector<Rational>& roots, const Rational& leading) {
    PowerPolynomial result{leading};
    for (const Rational& root : roots)
        result = multiplied(result, {Rational(-root), Rational(1)});
    return result;
}

/// The definition of the Bernstein form, multiplied out.
template <int Degree>
PowerPolynomial power_form(const Bernstein<Degree, Rational>& p) {
    const PowerPolynomial tau{Rational(0), Rational(1)};
    const PowerPolynomial rest{Rational(1), Rational(-1)};
    PowerPolynomial result;
    for (int i = 0; i <= Degree; ++i) {
        PowerPolynomial term = trimmed({Rational(p[i] * Rational(algebra::binomial(Degree, i)))});
        for (int k = 0; k < Degree; ++k)
            term = multiplied(term, k < i ? tau : rest);
        result = sum(result, term);
    }
    return result;
}

/// The inverse of power_form: tau^j = tau^j (tau + (1 - tau))^(Degree - j), multiplied out.
template <int Degree>
Bernstein<Degree, Rational> bernstein_form(const PowerPolynomial& p) {
    Bernstein<Degree, Rational> result;
    for (int k = 0; k <= Degree; ++k) {
        Rational coefficient(0);
        for (int j = 0; j <= k && j <= degree(p); ++j)
            coefficient += p[static_cast<std::size_t>(j)] * Rational(algebra::binomial(Degree - j, k - j));
        result.set(k, coefficient / Rational(algebra::binomial(Degree, k)));
    }
    return result;
}

} // namespace chasles::test
