// A polynomial of time with bounds of its values and rates. Source: docs/derivations/26-frames.md, "Polynomials".
#pragma once

#include "chasles/algebra/bracket.h"
#include "chasles/algebra/double_double.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace chasles::motion {

/// Sum of c_k time^k.
class TimePolynomial {
public:
    TimePolynomial() = default;
    explicit TimePolynomial(std::vector<double> coefficients) : coefficients_(std::move(coefficients)) {}

    [[nodiscard]] double at(double time) const {
        double value = 0;
        for (std::size_t k = coefficients_.size(); k-- > 0;)
            value = value * time + coefficients_[k];
        return value;
    }
    [[nodiscard]] TimePolynomial derivative() const {
        std::vector<double> rates;
        for (std::size_t k = 1; k < coefficients_.size(); ++k)
            rates.push_back(double(k) * coefficients_[k]);
        return TimePolynomial(std::move(rates));
    }
    /// The sum of the sizes of all coefficients: no value in [0, 1] is larger.
    [[nodiscard]] double size() const {
        double sum = 0;
        for (const double c : coefficients_)
            sum += std::abs(c);
        return sum;
    }
    /// A bound of the magnitude in an interval within [0, 1]: by the Taylor series about its middle.
    [[nodiscard]] double bound(const Bracket& times) const {
        constexpr double rounding = 1e-13; // of all terms, for degrees up to some hundred
        const double middle = 0.5 * (times.lower + times.upper);
        const double half = 0.5 * (times.upper - times.lower);
        TimePolynomial rate = *this;
        double sum = 0, power = 1;
        for (std::size_t k = 0; !rate.coefficients_.empty(); ++k) {
            sum += std::abs(rate.at(middle)) * power;
            power *= half / double(k + 1);
            rate = rate.derivative();
        }
        return sum + rounding * size();
    }
    [[nodiscard]] const std::vector<double>& coefficients() const { return coefficients_; }

private:
    std::vector<double> coefficients_;
};

/// A polynomial in double-double with the bounds of its first two rates.
class SmoothPolynomial {
public:
    using Wide = algebra::DoubleDouble;

    SmoothPolynomial() = default;
    explicit SmoothPolynomial(std::vector<Wide> coefficients) : coefficients_(std::move(coefficients)) {
        std::vector<double> rounded;
        for (const Wide& c : coefficients_)
            rounded.push_back(double(c));
        value_ = TimePolynomial(std::move(rounded));
        rate_ = value_.derivative();
        second_rate_ = rate_.derivative();
    }
    explicit SmoothPolynomial(const std::vector<double>& coefficients)
        : SmoothPolynomial(std::vector<Wide>(coefficients.begin(), coefficients.end())) {}

    [[nodiscard]] double at(double time) const { return value_.at(time); }
    [[nodiscard]] Wide at(const Wide& time) const {
        Wide value(0.0);
        for (std::size_t k = coefficients_.size(); k-- > 0;)
            value = value * time + coefficients_[k];
        return value;
    }
    [[nodiscard]] double size() const { return value_.size(); }
    /// The rounding of values, in units of a few roundings of `size()`.
    [[nodiscard]] double rounding() const { return 1 + double(coefficients_.size()) / 8; }
    [[nodiscard]] double rate(const Bracket& times) const { return rate_.bound(times); }
    [[nodiscard]] double second_rate(const Bracket& times) const { return second_rate_.bound(times); }

private:
    std::vector<Wide> coefficients_;
    TimePolynomial value_;
    TimePolynomial rate_;
    TimePolynomial second_rate_;
};

} // namespace chasles::motion
