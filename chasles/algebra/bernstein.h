// Polynomials of fixed degree on [0, 1] in Bernstein form: the coefficients enclose the values.
// Source: G. Farin, "Curves and Surfaces for CAGD", on blossoms; docs/derivations/06-first-feasible.md.
#pragma once

#include "chasles/algebra/lanes.h"

#include <cstdint>

namespace chasles::algebra {

/// sum over i of c_i * binomial(Degree, i) * tau^i * (1 - tau)^(Degree - i), for tau in [0, 1].
template <int Degree, class Scalar>
struct Bernstein {
    static_assert(Degree >= 0);
    Lanes<Degree + 1, Scalar> coefficients{};

    Bernstein() = default;
    explicit Bernstein(const Lanes<Degree + 1, Scalar>& lanes) : coefficients(lanes) {}

    static Bernstein constant(const Scalar& value) { return Bernstein(Lanes<Degree + 1, Scalar>::all(value)); }

    decltype(auto) operator[](int i) const { return coefficients[static_cast<std::size_t>(i)]; }
    void set(int i, const Scalar& value) { coefficients.set(static_cast<std::size_t>(i), value); }

    friend Bernstein operator+(const Bernstein& a, const Bernstein& b) {
        return Bernstein(a.coefficients + b.coefficients);
    }
    friend Bernstein operator-(const Bernstein& a, const Bernstein& b) {
        return Bernstein(a.coefficients - b.coefficients);
    }
    friend Bernstein operator*(const Bernstein& a, const Scalar& s) {
        return Bernstein(a.coefficients * Lanes<Degree + 1, Scalar>::all(s));
    }
    friend Bernstein operator*(const Scalar& s, const Bernstein& a) { return a * s; }
};

/// a + t (b - a), as a convex combination: for t in [0, 1] the error is at most u (3 (1 - t) |a| + 2 t |b|), with u
/// the unit roundoff. It is relative in each term, so that it stays below a bound that is restricted the same way.
template <class Scalar>
Scalar mix(const Scalar& a, const Scalar& b, const Scalar& t) {
    return a * (Scalar(1) - t) + b * t;
}

/// The value at tau (de Casteljau); error at most 3 Degree unit roundoffs of the value with all coefficients positive.
template <int Degree, class Scalar>
Scalar value_at(const Bernstein<Degree, Scalar>& p, const Scalar& tau) {
    std::array<Scalar, Degree + 1> c;
    for (int i = 0; i <= Degree; ++i)
        c[i] = p[i];
    for (int length = Degree; length > 0; --length)
        for (int i = 0; i < length; ++i)
            c[i] = mix(c[i], c[i + 1], tau);
    return c[0];
}

/// The same polynomial on [from, to], again over [0, 1]: its coefficients are the blossom at Degree - k times `from`
/// and k times `to`. All weights are convex: errors are 3 Degree unit roundoffs of the magnitudes, restricted alike.
template <int Degree, class Scalar>
Bernstein<Degree, Scalar> restricted(const Bernstein<Degree, Scalar>& p, const Scalar& from, const Scalar& to) {
    std::array<std::array<Scalar, Degree + 1>, Degree + 1> blossom; // [k][i]: k arguments are `to`, i-th window
    for (int i = 0; i <= Degree; ++i)
        blossom[0][i] = p[i];
    for (int step = 1; step <= Degree; ++step) {
        const int windows = Degree - step + 1;
        for (int i = 0; i < windows; ++i)
            blossom[step][i] = mix(blossom[step - 1][i], blossom[step - 1][i + 1], to);
        for (int k = 0; k < step; ++k)
            for (int i = 0; i < windows; ++i)
                blossom[k][i] = mix(blossom[k][i], blossom[k][i + 1], from);
    }
    Bernstein<Degree, Scalar> result;
    for (int k = 0; k <= Degree; ++k)
        result.set(k, blossom[k][0]);
    return result;
}

/// Binomial coefficient, exact in 64 bits for the degrees in use.
constexpr std::int64_t binomial(int n, int k) {
    std::int64_t result = 1;
    for (int i = 1; i <= k; ++i)
        result = result * (n - k + i) / i;
    return result;
}

/// The product, of the summed degree.
template <int P, int Q, class Scalar>
Bernstein<P + Q, Scalar> product(const Bernstein<P, Scalar>& a, const Bernstein<Q, Scalar>& b) {
    Bernstein<P + Q, Scalar> result;
    for (int k = 0; k <= P + Q; ++k) {
        Scalar sum(0);
        for (int i = (k > Q ? k - Q : 0); i <= (k < P ? k : P); ++i)
            sum = sum + Scalar(double(binomial(P, i) * binomial(Q, k - i))) * a[i] * b[k - i];
        result.set(k, Scalar(sum / Scalar(double(binomial(P + Q, k)))));
    }
    return result;
}

/// The same polynomial written with a higher degree.
template <int Higher, int Degree, class Scalar>
Bernstein<Higher, Scalar> elevated(const Bernstein<Degree, Scalar>& p) {
    return product(p, Bernstein<Higher - Degree, Scalar>::constant(Scalar(1)));
}

/// The same coefficients in another scalar.
template <class To, int Degree, class From>
Bernstein<Degree, To> converted(const Bernstein<Degree, From>& p) {
    Bernstein<Degree, To> result;
    for (int i = 0; i <= Degree; ++i)
        result.set(i, static_cast<To>(p[i]));
    return result;
}

/// Proven signs: of p on [0, 1] when its coefficients are known to within `error` coefficient by coefficient.
template <int Degree, class Scalar>
bool is_positive(const Bernstein<Degree, Scalar>& p, const Bernstein<Degree, Scalar>& error) {
    return all_above(p.coefficients, error.coefficients);
}
template <int Degree, class Scalar>
bool is_negative(const Bernstein<Degree, Scalar>& p, const Bernstein<Degree, Scalar>& error) {
    return is_positive(Bernstein<Degree, Scalar>() - p, error);
}

} // namespace chasles::algebra
