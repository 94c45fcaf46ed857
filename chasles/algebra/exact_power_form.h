// Polynomials as sums of c_j tau^j with exact coefficients. Euclid's algorithm with pseudo-division gives common
// divisors. Source: D. Knuth, "The Art of Computer Programming", volume 2, section 4.6.1;
// docs/derivations/12-exact-stage.md.
#pragma once

#include "chasles/algebra/bernstein.h"
#include "chasles/algebra/exact_number.h"

#include <numeric>
#include <utility>
#include <vector>

namespace chasles::algebra {

/// Coefficient j belongs to tau^j. The last coefficient is not zero. The zero polynomial has no coefficients.
using PowerForm = std::vector<ExactNumber>;

/// The same polynomial without zero coefficients at the end.
inline PowerForm trimmed(PowerForm p) {
    while (!p.empty() && p.back().sign() == 0)
        p.pop_back();
    return p;
}

/// The power coefficients of a polynomial in Bernstein form.
template <int Degree>
PowerForm power_form(const Bernstein<Degree, ExactNumber>& p) {
    PowerForm result;
    for (int j = 0; j <= Degree; ++j) {
        ExactNumber difference;
        for (int i = 0; i <= j; ++i)
            difference = difference + p[i] * ExactNumber(double(((j - i) % 2 == 0 ? 1 : -1) * binomial(j, i)));
        result.push_back(difference * ExactNumber(double(binomial(Degree, j))));
    }
    return trimmed(std::move(result));
}

/// A positive multiple of p in Bernstein form. The degree of p must be at most Degree.
template <int Degree>
Bernstein<Degree, ExactNumber> bernstein_form(const PowerForm& p) {
    std::int64_t multiple = 1;
    for (int j = 0; j <= Degree; ++j)
        multiple = std::lcm(multiple, binomial(Degree, j));
    Bernstein<Degree, ExactNumber> result;
    for (int k = 0; k <= Degree; ++k) {
        ExactNumber sum;
        for (int j = 0; j <= k && j < int(p.size()); ++j) {
            const std::int64_t share = multiple / binomial(Degree, j); // a whole number
            sum = sum + p[std::size_t(j)] * ExactNumber(double(share * binomial(k, j)));
        }
        result.set(k, sum);
    }
    return result;
}

/// The derivative with respect to tau.
inline PowerForm derivative(const PowerForm& p) {
    PowerForm result;
    for (std::size_t j = 1; j < p.size(); ++j)
        result.push_back(p[j] * ExactNumber(double(j)));
    return result;
}

/// The equation c a = quotient b + remainder, with c a power of the leading coefficient of b.
struct PseudoDivision {
    PowerForm quotient;
    PowerForm remainder;
};

/// Divides without division of coefficients: multiplies a by the leading coefficient of b before each step.
inline PseudoDivision pseudo_division(PowerForm a, const PowerForm& b) {
    PowerForm quotient(a.size() < b.size() ? 0 : a.size() - b.size() + 1);
    while (a.size() >= b.size()) {
        const ExactNumber leading = a.back();
        const std::size_t shift = a.size() - b.size();
        for (ExactNumber& c : a)
            c = c * b.back();
        for (ExactNumber& c : quotient)
            c = c * b.back();
        quotient[shift] = quotient[shift] + leading;
        for (std::size_t i = 0; i < b.size(); ++i)
            a[shift + i] = a[shift + i] - leading * b[i];
        a = trimmed(std::move(a));
    }
    return {trimmed(std::move(quotient)), std::move(a)};
}

/// A greatest common divisor of a and b, up to a constant factor.
inline PowerForm common_divisor(PowerForm a, PowerForm b) {
    while (!b.empty()) {
        PowerForm next = pseudo_division(std::move(a), b).remainder;
        a = std::move(b);
        b = std::move(next);
    }
    return a;
}

/// A polynomial with the same roots as p, all of them simple. p must not be zero.
inline PowerForm without_multiple_roots(const PowerForm& p) {
    const PowerForm multiple = common_divisor(p, derivative(p));
    return multiple.size() < 2 ? p : pseudo_division(p, multiple).quotient;
}

} // namespace chasles::algebra
