// Conversions between the exact scalars of the library and the rationals of the tests.
#pragma once

#include "chasles/algebra/exact_number.h"
#include "tests/support/rational.h"

#include <gtest/gtest.h>

namespace chasles::test {

using algebra::Dyadic;
using algebra::ExactNumber;

inline Rational power_of_two(int exponent) {
    Rational power(1);
    for (int i = 0; i < std::abs(exponent); ++i)
        power *= 2;
    return exponent < 0 ? Rational(1 / power) : power;
}

inline Rational exact(const Dyadic& x) {
    return Rational(x.mantissa().str()) * power_of_two(x.exponent());
}

/// The exact number of a whole number.
inline ExactNumber exact_number(const Rational& whole) {
    EXPECT_EQ(denominator(whole), 1);
    return Dyadic(Dyadic::Integer(numerator(whole).str()), 0);
}

template <int Degree>
Rational common_denominator(const Bernstein<Degree, Rational>& p) {
    Rational multiple(1);
    for (int i = 0; i <= Degree; ++i)
        multiple *= Rational(denominator(p[i]));
    return multiple;
}

/// A positive multiple of the polynomial with whole coefficients.
template <int Degree>
Bernstein<Degree, ExactNumber> whole_multiple(const Bernstein<Degree, Rational>& p, const Rational& multiple) {
    Bernstein<Degree, ExactNumber> result;
    for (int i = 0; i <= Degree; ++i)
        result.set(i, exact_number(p[i] * multiple));
    return result;
}
template <int Degree>
Bernstein<Degree, ExactNumber> whole_multiple(const Bernstein<Degree, Rational>& p) {
    return whole_multiple(p, common_denominator(p));
}

} // namespace chasles::test
