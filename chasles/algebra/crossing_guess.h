// A guess of the first zero of a polynomial, computed in double without an error bound. No proof depends on the guess.
// Source: A. Householder, "The Numerical Treatment of a Single Nonlinear Equation", 1970, on steps of higher order;
// docs/derivations/06-first-feasible.md, section "Guess".
#pragma once

#include "chasles/algebra/bernstein.h"

#include <cmath>
#include <optional>

namespace chasles::algebra {

/// An approximate zero of p with the Taylor polynomial p(t) = slope (t - tau) + slope curvature (t - tau)^2 + ...
struct Crossing {
    double tau;
    double slope;
    double curvature; ///< relative to the slope
};

namespace detail {

/// The power coefficients of tau^0 to tau^Degree.
template <int Degree>
std::array<double, Degree + 1> monomial_form(const Bernstein<Degree, double>& p) {
    std::array<double, Degree + 1> powers;
    for (int i = 0; i <= Degree; ++i)
        powers[i] = p[i];
    for (int order = 1; order <= Degree; ++order)
        for (int i = Degree; i >= order; --i)
            powers[i] -= powers[i - 1];
    for (int i = 0; i <= Degree; ++i)
        powers[i] *= double(binomial(Degree, i));
    return powers;
}

/// The first four Taylor coefficients at `at`, by Horner's scheme.
template <std::size_t Size>
std::array<double, 4> taylor_at(std::array<double, Size> powers, double at) {
    std::array<double, 4> taylor{};
    for (std::size_t order = 0; order < std::min<std::size_t>(4, Size); ++order) {
        for (std::size_t i = Size - 1; i > order; --i)
            powers[i - 1] += powers[i] * at;
        taylor[order] = powers[order];
    }
    return taylor;
}

/// The first zero of the control polygon, or empty if the coefficients have one sign.
template <int Degree>
std::optional<double> first_change_of_sign(const Bernstein<Degree, double>& p) {
    for (int i = 0; i < Degree; ++i)
        if ((p[i] < 0) != (p[i + 1] < 0))
            return (i + p[i] / (p[i] - p[i + 1])) * (1.0 / Degree);
    return std::nullopt;
}

} // namespace detail

/// The zero that steps of fourth order find from `start`. Empty if five steps do not converge or leave ]0, 1[.
template <int Degree>
std::optional<Crossing> crossing_near(const Bernstein<Degree, double>& p, double start) {
    constexpr int max_steps = 5;
    constexpr double last_step = 0x1p-14; // the next step would be below rounding
    const std::array<double, Degree + 1> powers = detail::monomial_form(p);
    double tau = start;
    for (int step = 0; step < max_steps; ++step) {
        const auto [value, slope, second, third] = detail::taylor_at(powers, tau);
        const double inverse = 1 / slope;
        const double newton = value * inverse;
        const double curvature = second * inverse;
        const double move =
            newton * (1 + newton * (curvature + newton * (2 * curvature * curvature - third * inverse)));
        tau -= move;
        if (!(tau > 0 && tau < 1))
            return std::nullopt;
        if (std::abs(move) < last_step)
            return Crossing{tau, slope, curvature};
    }
    return std::nullopt;
}

/// The zero that the same steps find from the first zero of the control polygon.
template <int Degree>
std::optional<Crossing> first_crossing(const Bernstein<Degree, double>& p) {
    const auto start = detail::first_change_of_sign(p);
    return start ? crossing_near(p, *start) : std::nullopt;
}

} // namespace chasles::algebra
