// Polynomials in tau for the exact reference, in whole numbers or in doubles with error bounds. This header shares no
// code with chasles/, so an error in chasles/ cannot affect the reference.
#pragma once

#include <array>
#include <boost/multiprecision/gmp.hpp>
#include <cmath>

namespace chasles::reference {

using Integer = boost::multiprecision::number<boost::multiprecision::gmp_int, boost::multiprecision::et_off>;
using Rational = boost::multiprecision::number<boost::multiprecision::gmp_rational, boost::multiprecision::et_off>;

inline int sign_of(const Integer& x) {
    return x.sign();
}

/// A double with the sum of the magnitudes of its terms. After n successive operations its error is at most (n + 1)
/// 2^-53 of this sum. The bound 2^-44 allows for 500 operations; the reference needs fewer than 60. Numbers have a
/// magnitude of about one or zero, so any underflow is far below the last term.
struct Tracked {
    double value = 0;
    double size = 0;

    friend Tracked operator+(const Tracked& a, const Tracked& b) { return {a.value + b.value, a.size + b.size}; }
    friend Tracked operator-(const Tracked& a, const Tracked& b) { return {a.value - b.value, a.size + b.size}; }
    friend Tracked operator*(const Tracked& a, const Tracked& b) { return {a.value * b.value, a.size * b.size}; }
};

/// The sign if it is proven, otherwise 0.
inline int sign_of(const Tracked& x) {
    const double bound = 0x1p-44 * x.size + 1e-280;
    return x.value > bound ? 1 : x.value < -bound ? -1 : 0;
}

/// Coefficients of 1, tau, ..., tau^Degree.
template <class N, int Degree>
using Polynomial = std::array<N, Degree + 1>;

template <class N, std::size_t A, std::size_t B>
std::array<N, A + B - 1> operator*(const std::array<N, A>& a, const std::array<N, B>& b) {
    std::array<N, A + B - 1> result{};
    for (std::size_t i = 0; i < A; ++i)
        for (std::size_t j = 0; j < B; ++j)
            result[i + j] = result[i + j] + a[i] * b[j];
    return result;
}

template <class N, std::size_t A>
std::array<N, A> operator*(const std::array<N, A>& a, const N& b) {
    std::array<N, A> result;
    for (std::size_t i = 0; i < A; ++i)
        result[i] = a[i] * b;
    return result;
}

template <class N, std::size_t A, std::size_t B>
auto operator+(const std::array<N, A>& a, const std::array<N, B>& b) {
    std::array<N, std::max(A, B)> result{};
    for (std::size_t i = 0; i < result.size(); ++i)
        result[i] = i >= A ? b[i] : i >= B ? a[i] : a[i] + b[i];
    return result;
}

template <class N, std::size_t A, std::size_t B>
auto operator-(const std::array<N, A>& a, const std::array<N, B>& b) {
    std::array<N, std::max(A, B)> result{};
    for (std::size_t i = 0; i < result.size(); ++i)
        result[i] = i >= A ? N{} - b[i] : i >= B ? a[i] : a[i] - b[i];
    return result;
}

/// Three polynomials, or three numbers as polynomials of degree 0.
template <class N, int Degree>
using Vector = std::array<Polynomial<N, Degree>, 3>;

template <class N>
Vector<N, 0> constant(const std::array<N, 3>& v) {
    return {Polynomial<N, 0>{v[0]}, Polynomial<N, 0>{v[1]}, Polynomial<N, 0>{v[2]}};
}

template <class P, class Q>
auto dot(const std::array<P, 3>& a, const std::array<Q, 3>& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

template <class P, class Q>
auto cross(const std::array<P, 3>& a, const std::array<Q, 3>& b) {
    const auto component = [&](std::size_t j, std::size_t k) { return a[j] * b[k] - a[k] * b[j]; };
    return std::array{component(1, 2), component(2, 0), component(0, 1)};
}

template <class P, class Q>
auto difference(const std::array<P, 3>& a, const std::array<Q, 3>& b) {
    return std::array{a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

template <class P, class Q>
auto sum(const std::array<P, 3>& a, const std::array<Q, 3>& b) {
    return std::array{a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}

template <class P, class Q>
auto scaled(const std::array<P, 3>& a, const Q& b) {
    return std::array{a[0] * b, a[1] * b, a[2] * b};
}

/// Binomial coefficients for degrees up to 7.
inline long binomial(std::size_t n, std::size_t k) {
    long result = 1;
    for (std::size_t i = 0; i < k; ++i)
        result = result * long(n - i) / long(i + 1);
    return result;
}

inline Tracked whole(const Tracked&, long x) {
    return {double(x), double(x)};
}
inline Integer whole(const Integer&, long x) {
    return Integer(x);
}

/// The sign of a polynomial on all of [0, 1], by its Bernstein coefficients; 0 if no sign is proven.
template <class N, std::size_t Count>
int kept_sign(const std::array<N, Count>& p) {
    int kept = 0;
    for (std::size_t k = 0; k < Count; ++k) { // binomial(n, k) times the coefficient
        N coefficient = p[0] * whole(p[0], binomial(Count - 1, k));
        for (std::size_t i = 1; i <= k; ++i)
            coefficient = coefficient + p[i] * whole(p[0], binomial(Count - 1 - i, k - i));
        const int sign = sign_of(coefficient);
        if (sign == 0 || sign * kept < 0)
            return 0;
        kept = sign;
    }
    return kept;
}

} // namespace chasles::reference
