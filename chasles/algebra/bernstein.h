// Polynomials of fixed degree on [0, 1] in Bernstein form. The smallest and the greatest coefficient enclose all
// values. Source: G. Farin, "Curves and Surfaces for CAGD", on blossoms; docs/derivations/06-first-feasible.md.
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

    static Bernstein constant(const Scalar& value) { return Bernstein(Lanes<Degree + 1, Scalar>::broadcast(value)); }

    decltype(auto) operator[](int i) const { return coefficients[static_cast<std::size_t>(i)]; }
    void set(int i, const Scalar& value) { coefficients.set(static_cast<std::size_t>(i), value); }

    friend Bernstein operator+(const Bernstein& a, const Bernstein& b) {
        return Bernstein(a.coefficients + b.coefficients);
    }
    friend Bernstein operator-(const Bernstein& a, const Bernstein& b) {
        return Bernstein(a.coefficients - b.coefficients);
    }
    friend Bernstein operator*(const Bernstein& a, const Scalar& s) {
        return Bernstein(a.coefficients * Lanes<Degree + 1, Scalar>::broadcast(s));
    }
    friend Bernstein operator*(const Scalar& s, const Bernstein& a) { return a * s; }
};

/// a + t (b - a), computed as a convex combination. For t in [0, 1] the error is at most u (3 (1 - t) |a| + 2 t |b|),
/// with u the unit roundoff. The error is relative to each term. It therefore stays below an error bound that is
/// interpolated in the same way.
template <class Scalar>
Scalar mix(const Scalar& a, const Scalar& b, const Scalar& t) {
    return a * (Scalar(1) - t) + b * t;
}

/// The value at tau by de Casteljau's algorithm. The error is at most 3 Degree unit roundoffs times the value of the
/// polynomial with the magnitudes of the coefficients.
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

/// The error that `Restriction` adds is at most this many unit roundoffs times the restricted coefficient magnitudes
/// (docs/derivations/06-first-feasible.md, "Restriction").
template <int Degree>
inline constexpr int restriction_units = Degree <= 3 ? 3 * Degree : 4 * Degree - 1;

/// Restricts polynomials to [from, to] and maps that interval to [0, 1]. The new coefficient k is the blossom with the
/// arguments `from`, Degree - k times, and `to`, k times. It is a convex combination of the old coefficients. The
/// constructor computes the weights once for any number of polynomials.
template <int Degree, class Scalar>
class Restriction {
public:
    Restriction(const Scalar& from, const Scalar& to) {
        weights_[0] = Column::broadcast(Scalar(1));
        for (int step = 0; step < Degree; ++step) {
            Column argument;
            for (int k = 0; k <= Degree; ++k)
                argument.set(static_cast<std::size_t>(k), uses_to(k, step) ? to : from);
            const Column rest = Column::broadcast(Scalar(1)) - argument;
            weights_[step + 1] = weights_[step] * argument;
            for (int i = step; i > 0; --i)
                weights_[i] = weights_[i] * rest + weights_[i - 1] * argument;
            weights_[0] = weights_[0] * rest;
        }
    }

    Bernstein<Degree, Scalar> operator()(const Bernstein<Degree, Scalar>& p) const {
        Column sum = weights_[0] * Column::broadcast(p[0]);
        for (int i = 1; i <= Degree; ++i)
            sum = sum + weights_[i] * Column::broadcast(p[i]);
        return Bernstein<Degree, Scalar>(sum);
    }

private:
    using Column = Lanes<Degree + 1, Scalar>;

    /// Whether argument `step` of the blossom is `to`. The more frequent argument comes first, which rounds least.
    static constexpr bool uses_to(int k, int step) { return 2 * k > Degree ? step < k : step >= Degree - k; }

    std::array<Column, Degree + 1> weights_; ///< [i]: the weights of the old coefficient i in all new coefficients
};

/// One polynomial restricted to [from, to].
template <int Degree, class Scalar>
Bernstein<Degree, Scalar> restricted(const Bernstein<Degree, Scalar>& p, const Scalar& from, const Scalar& to) {
    return Restriction<Degree, Scalar>(from, to)(p);
}

/// The binomial coefficient "n choose k", exact in 64 bits for all degrees in use.
constexpr std::int64_t binomial(int n, int k) {
    std::int64_t result = 1;
    for (int i = 1; i <= k; ++i)
        result = result * (n - k + i) / i;
    return result;
}

/// The product, of degree P + Q. Coefficients that are scaled by their binomials multiply like power coefficients.
template <int P, int Q, class Scalar>
Bernstein<P + Q, Scalar> product(const Bernstein<P, Scalar>& a, const Bernstein<Q, Scalar>& b) {
    std::array<Scalar, P + 1> scaled_a;
    std::array<Scalar, Q + 1> scaled_b;
    for (int i = 0; i <= P; ++i)
        scaled_a[i] = Scalar(double(binomial(P, i))) * a[i];
    for (int j = 0; j <= Q; ++j)
        scaled_b[j] = Scalar(double(binomial(Q, j))) * b[j];
    std::array<Scalar, P + Q + 1> sums{};
    for (int i = 0; i <= P; ++i)
        for (int j = 0; j <= Q; ++j)
            sums[i + j] = sums[i + j] + scaled_a[i] * scaled_b[j];
    Bernstein<P + Q, Scalar> result;
    for (int k = 0; k <= P + Q; ++k)
        result.set(k, Scalar(sums[k] / Scalar(double(binomial(P + Q, k)))));
    return result;
}

/// The same polynomial, written in the basis of a higher degree.
template <int Higher, int Degree, class Scalar>
Bernstein<Higher, Scalar> elevated(const Bernstein<Degree, Scalar>& p) {
    return product(p, Bernstein<Higher - Degree, Scalar>::constant(Scalar(1)));
}

/// The coefficients converted to another scalar.
template <class To, int Degree, class From>
Bernstein<Degree, To> converted(const Bernstein<Degree, From>& p) {
    Bernstein<Degree, To> result;
    for (int i = 0; i <= Degree; ++i)
        result.set(i, static_cast<To>(p[i]));
    return result;
}

/// Whether p is proven to be positive on [0, 1]. Coefficient i of p is known to within coefficient i of `error`.
template <int Degree, class Scalar>
bool is_positive(const Bernstein<Degree, Scalar>& p, const Bernstein<Degree, Scalar>& error) {
    return all_above(p.coefficients, error.coefficients);
}
/// Whether p is proven to be negative on [0, 1].
template <int Degree, class Scalar>
bool is_negative(const Bernstein<Degree, Scalar>& p, const Bernstein<Degree, Scalar>& error) {
    return is_positive(Bernstein<Degree, Scalar>() - p, error);
}
/// Whether p is proven to have no zero on [0, 1].
template <int Degree, class Scalar>
bool keeps_one_sign(const Bernstein<Degree, Scalar>& p, const Bernstein<Degree, Scalar>& error) {
    return is_positive(p, error) || is_negative(p, error);
}

} // namespace chasles::algebra
