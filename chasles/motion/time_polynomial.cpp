// Bounds the rates of a polynomial by its Taylor series. Source: docs/derivations/26-frames.md, "Polynomials".
#include "chasles/motion/time_polynomial.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

namespace chasles::motion {

namespace {

/// The factor of the power k in the derivative of this order: k (k - 1) ...
double derived(std::size_t k, std::size_t order) {
    double factor = 1;
    for (std::size_t i = 0; i < order; ++i)
        factor *= double(k - i);
    return factor;
}

/// The sum of the sizes of all terms of a derivative at a time of at most 1.
double sum_of_derivative(std::span<const double> coefficients, std::size_t order, double time) {
    double sum = 0, power = 1;
    for (std::size_t k = order; k < coefficients.size(); ++k) {
        sum += derived(k, order) * std::abs(coefficients[k]) * power;
        power *= time;
    }
    return sum;
}

/// Replaces the coefficients by those of the Taylor series about a time.
template <class S>
void shift(std::span<S> coefficients, const S& time) {
    for (std::size_t first = 0; first + 1 < coefficients.size(); ++first)
        for (std::size_t k = coefficients.size() - 1; k-- > first;)
            coefficients[k] = coefficients[k] + time * coefficients[k + 1];
}

using Wide = algebra::DoubleDouble;

/// a + sign b.
std::vector<Wide> sum(std::vector<Wide> a, std::span<const Wide> b, double sign) {
    a.resize(std::max(a.size(), b.size()));
    for (std::size_t k = 0; k < b.size(); ++k)
        a[k] = a[k] + Wide(sign) * b[k];
    return a;
}

} // namespace

TimePolynomial::TimePolynomial(std::vector<Wide> coefficients) : coefficients_(std::move(coefficients)) {
    for (const Wide& c : coefficients_)
        in_double_.push_back(double(c));
    for (std::size_t order = 0; order < sizes_.size(); ++order)
        sizes_[order] = sum_of_derivative(in_double_, order, 1);
}

TimePolynomial TimePolynomial::derivative() const {
    std::vector<Wide> rates;
    for (std::size_t k = 1; k < coefficients_.size(); ++k)
        rates.push_back(Wide(double(k)) * coefficients_[k]);
    return TimePolynomial(std::move(rates));
}

/// b_k = sum over j of binomial(k, j) / binomial(n, j) c_j.
std::vector<Wide> TimePolynomial::bernstein() const {
    std::vector<Wide> result(coefficients_.size());
    for (std::size_t k = 0; k < result.size(); ++k) {
        Wide share(1.0);
        for (std::size_t j = 0; j <= k; ++j) {
            result[k] = result[k] + share * coefficients_[j];
            if (j < k)
                share = share * Wide(double(k - j)) / Wide(double(result.size() - 1 - j));
        }
    }
    return result;
}

TimePolynomial TimePolynomial::part(double from, double to) const {
    std::vector<Wide> coefficients = coefficients_;
    shift<Wide>(coefficients, Wide(from));
    const Wide duration = Wide(to) - Wide(from);
    Wide power(1.0);
    for (Wide& c : coefficients) {
        c = c * power;
        power = power * duration;
    }
    return TimePolynomial(std::move(coefficients));
}

TimePolynomial operator+(const TimePolynomial& a, const TimePolynomial& b) {
    return TimePolynomial(sum(a.coefficients_, b.coefficients_, 1));
}

TimePolynomial operator-(const TimePolynomial& a, const TimePolynomial& b) {
    return TimePolynomial(sum(a.coefficients_, b.coefficients_, -1));
}

PolynomialRates TimePolynomial::rates(const Bracket& times) const {
    constexpr double rounding = 1e-13; // of all terms, for degrees up to some hundred
    constexpr std::size_t short_size = 8;
    std::array<double, short_size>
        short_copy; // NOLINT(cppcoreguidelines-pro-type-member-init): is set where it is used
    std::vector<double> long_copy;
    const std::size_t count = in_double_.size();
    if (count > short_size)
        long_copy.resize(count);
    const std::span<double> series(count > short_size ? long_copy.data() : short_copy.data(), count);
    std::ranges::copy(in_double_, series.begin());
    shift<double>(series, 0.5 * (times.lower + times.upper));
    PolynomialRates rates;
    rates.first = count > 1 ? series[1] : 0;
    rates.second = count > 2 ? 2 * series[2] : 0;
    for (std::size_t order = 1; order < sizes_.size(); ++order)
        rates.bounds[order - 1] =
            sum_of_derivative(series, order, 0.5 * (times.upper - times.lower)) + rounding * sizes_[order];
    return rates;
}

} // namespace chasles::motion
