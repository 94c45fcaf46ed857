// Exact rationals for the tests: the scalar of the library's templates and of all oracles.
#pragma once

#include "chasles/algebra/bernstein.h"
#include "chasles/algebra/double_double.h"
#include "chasles/algebra/vector.h"

#include <boost/multiprecision/gmp.hpp>
#include <utility>

namespace chasles::test {

using Rational = boost::multiprecision::number<boost::multiprecision::gmp_rational, boost::multiprecision::et_off>;
using algebra::Bernstein;
using algebra::DoubleDouble;
using algebra::Vector3;

inline Rational exact(double x) {
    return Rational(x);
}
inline Rational exact(const DoubleDouble& x) {
    return Rational(x.high()) + Rational(x.low());
}
inline Rational exact(const Rational& x) {
    return x;
}

template <class S>
Vector3<Rational> exact(const Vector3<S>& v) {
    return {exact(v.x), exact(v.y), exact(v.z)};
}

template <int Degree, class S>
Bernstein<Degree, Rational> exact(const Bernstein<Degree, S>& p) {
    Bernstein<Degree, Rational> result;
    for (int i = 0; i <= Degree; ++i)
        result.set(i, exact(p[i]));
    return result;
}

/// The number in another scalar, rounded if necessary.
template <class S>
S rounded_to(const Rational& x) {
    return S(x);
}
template <>
inline double rounded_to<double>(const Rational& x) {
    return static_cast<double>(x);
}
template <>
inline DoubleDouble rounded_to<DoubleDouble>(const Rational& x) {
    const auto high = static_cast<double>(x);
    return DoubleDouble(high) + DoubleDouble(static_cast<double>(Rational(x - Rational(high))));
}

template <class S>
Vector3<S> rounded_to(const Vector3<Rational>& v) {
    return {rounded_to<S>(v.x), rounded_to<S>(v.y), rounded_to<S>(v.z)};
}

template <class S, int Degree>
Bernstein<Degree, S> rounded_to(const Bernstein<Degree, Rational>& p) {
    Bernstein<Degree, S> result;
    for (int i = 0; i <= Degree; ++i)
        result.set(i, rounded_to<S>(p[i]));
    return result;
}

inline Rational ratio(int numerator, int denominator) {
    return Rational(numerator) / Rational(denominator);
}

inline Rational magnitude(const Rational& x) {
    return x < 0 ? Rational(-x) : x;
}

template <int Degree>
Rational largest_coefficient(const Bernstein<Degree, Rational>& p) {
    Rational largest(0);
    for (int i = 0; i <= Degree; ++i)
        largest = std::max(largest, magnitude(p[i]));
    return largest;
}

/// Calls check(std::integral_constant<int, degree>) for each degree from First to Last.
template <int First, int Last, class Check>
void for_degrees(Check check) {
    [&]<int... I>(std::integer_sequence<int, I...>) {
        (check(std::integral_constant<int, First + I>()), ...);
    }(std::make_integer_sequence<int, Last - First + 1>());
}

} // namespace chasles::test
