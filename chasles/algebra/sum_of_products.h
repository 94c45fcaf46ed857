// Sums of products of cubics over one weight, with error bounds from the actual coefficients. Squared distances are
// sums of this kind. Source: docs/derivations/16-margin.md, "Bounds".
#pragma once

#include "chasles/algebra/feasibility_problem.h"
#include "chasles/algebra/unit_roundoff.h"

namespace chasles::algebra {

/// A cubic with a size: the magnitude of coefficient i is at most size * weight_i.
template <class Scalar>
struct Sized {
    Bounded<3, Scalar> cubic;
    Scalar size{};
};

/// A cubic with its least size, up to two roundings.
template <class Scalar>
Sized<Scalar> sized(const Bounded<3, Scalar>& cubic, const Bernstein<3, Scalar>& weight) {
    const auto magnitudes = magnitude(cubic.polynomial.coefficients);
    Scalar size(0);
    for (int i = 0; i <= 3; ++i) {
        const Scalar ratio = magnitudes[static_cast<std::size_t>(i)] / weight[i];
        size = size < ratio ? ratio : size;
    }
    return {cubic, size};
}

/// A sum of products of degree six over the square of the weight.
template <class Scalar>
class SumOfProducts {
public:
    /// Adds a b.
    void add(const Sized<Scalar>& a, const Sized<Scalar>& b) {
        const Scalar& a_error = a.cubic.error;
        const Scalar& b_error = b.cubic.error;
        sum_ = sum_ + product(a.cubic.polynomial, b.cubic.polynomial);
        error_ = error_ + (a.size * b_error + a_error * b.size + a_error * b_error);
        size_ = size_ + a.size * b.size;
    }

    /// The product with a factor >= 0.
    [[nodiscard]] SumOfProducts scaled(const Scalar& factor) const {
        SumOfProducts result;
        result.sum_ = sum_ * factor;
        result.error_ = error_ * factor;
        result.size_ = size_ * factor;
        return result;
    }
    /// The difference. The error bounds of both sums add up.
    [[nodiscard]] SumOfProducts minus(const SumOfProducts& other) const {
        SumOfProducts result;
        result.sum_ = sum_ - other.sum_;
        result.error_ = error_ + other.error_;
        result.size_ = size_ + other.size_;
        return result;
    }

    /// The sum with its error bound. The bound covers the rounding of products, sums, restrictions and of itself.
    [[nodiscard]] Bounded<6, Scalar> bounded() const {
        constexpr double units = 48; // unit roundoffs, counted in the note
        constexpr double underflow = 0x1p-1000;
        const Scalar rounded = Scalar(units * unit_roundoff<Scalar>) * size_;
        return {sum_, Scalar(Scalar(1.0625) * (error_ + rounded) + Scalar(underflow))};
    }

private:
    Bernstein<6, Scalar> sum_;
    Scalar error_{};
    Scalar size_{};
};

} // namespace chasles::algebra
