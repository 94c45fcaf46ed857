// A polynomial of time with bounds of its rates. Source: docs/derivations/26-frames.md, "Polynomials".
#pragma once

#include "chasles/algebra/bracket.h"
#include "chasles/algebra/double_double.h"

#include <array>
#include <cstddef>
#include <vector>

namespace chasles::motion {

/// The rates of a polynomial about the middle of an interval.
struct PolynomialRates {
    double first = 0;               ///< in the middle
    double second = 0;              ///< likewise
    std::array<double, 3> bounds{}; ///< of the first, the second and the third rate during the interval
};

/// Sum of c_k time^k, in double-double.
class TimePolynomial {
public:
    using Wide = algebra::DoubleDouble;

    TimePolynomial() = default;
    explicit TimePolynomial(std::vector<Wide> coefficients);
    explicit TimePolynomial(const std::vector<double>& coefficients)
        : TimePolynomial(std::vector<Wide>(coefficients.begin(), coefficients.end())) {}

    [[nodiscard]] double at(double time) const { return value(in_double_, time); }
    [[nodiscard]] Wide at(const Wide& time) const { return value(coefficients_, time); }
    [[nodiscard]] bool is_straight() const { return sizes_[2] == 0; }
    [[nodiscard]] bool is_constant() const { return sizes_[1] == 0; }
    [[nodiscard]] bool is_zero() const { return sizes_[0] == 0; }
    [[nodiscard]] TimePolynomial derivative() const;
    /// The coefficients of the Bernstein form on [0, 1].
    [[nodiscard]] std::vector<Wide> bernstein() const;
    /// As a polynomial of the share of the way from one time in [0, 1] to another.
    [[nodiscard]] TimePolynomial part(double from, double to) const;
    friend TimePolynomial operator+(const TimePolynomial& a, const TimePolynomial& b);
    friend TimePolynomial operator-(const TimePolynomial& a, const TimePolynomial& b);
    [[nodiscard]] const std::vector<Wide>& coefficients() const { return coefficients_; }
    /// The sum of the sizes of all coefficients: no value in [0, 1] is larger.
    [[nodiscard]] double size() const { return sizes_[0]; }
    /// The rounding of values, in units of a few roundings of `size()`.
    [[nodiscard]] double rounding() const { return 1 + double(coefficients_.size()) / 8; }
    /// In an interval within [0, 1].
    [[nodiscard]] PolynomialRates rates(const Bracket& times) const;

private:
    template <class S>
    static S value(const std::vector<S>& coefficients, const S& time) {
        S value(0.0);
        for (std::size_t k = coefficients.size(); k-- > 0;)
            value = value * time + coefficients[k];
        return value;
    }

    std::vector<Wide> coefficients_;
    std::vector<double> in_double_;
    std::array<double, 4> sizes_{}; ///< of the polynomial and of its first three derivatives
};

} // namespace chasles::motion
