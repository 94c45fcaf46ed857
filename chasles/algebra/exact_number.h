// The scalar of the exact stage: a + b sqrt(n). Sums, differences, products and signs are exact.
// Source: docs/derivations/12-exact-stage.md.
#pragma once

#include "chasles/algebra/dyadic.h"
#include "chasles/algebra/unit_roundoff.h"

namespace chasles::algebra {

/// A number a + b sqrt(radicand) with dyadic a and b. All numbers of one computation must have the same radicand. They
/// keep a pointer to the radicand and do not own it. A number with b = 0 needs no radicand.
class ExactNumber {
public:
    ExactNumber() = default;
    ExactNumber(double x) : rational_(x) {}            // NOLINT(google-explicit-constructor)
    ExactNumber(Dyadic x) : rational_(std::move(x)) {} // NOLINT(google-explicit-constructor)

    /// The part a.
    [[nodiscard]] const Dyadic& rational() const { return rational_; }
    /// The factor b of the square root.
    [[nodiscard]] const Dyadic& irrational() const { return irrational_; }

    /// The square root of a radicand >= 0. The radicand must outlive the number.
    static ExactNumber root_of(const Dyadic& radicand) {
        ExactNumber root;
        root.irrational_ = Dyadic(1.0);
        root.radicand_ = &radicand;
        return root;
    }

    /// The number of binary digits of the longer part.
    [[nodiscard]] unsigned digits() const { return std::max(rational_.digits(), irrational_.digits()); }

    /// -1, 0 or 1. If a and b differ in sign, the sign of a^2 - b^2 n decides.
    [[nodiscard]] int sign() const {
        const int a = rational_.sign();
        const int b = radicand_ != nullptr && radicand_->sign() > 0 ? irrational_.sign() : 0;
        if (a * b >= 0)
            return a != 0 ? a : b;
        return a * (rational_ * rational_ - irrational_ * irrational_ * *radicand_).sign();
    }

    friend ExactNumber operator+(const ExactNumber& x, const ExactNumber& y) {
        return {x.rational_ + y.rational_, x.irrational_ + y.irrational_, x, y};
    }
    friend ExactNumber operator-(const ExactNumber& x) { return ExactNumber() - x; }
    friend ExactNumber operator-(const ExactNumber& x, const ExactNumber& y) {
        return {x.rational_ - y.rational_, x.irrational_ - y.irrational_, x, y};
    }
    friend ExactNumber operator*(const ExactNumber& x, const ExactNumber& y) {
        if (x.radicand_ == nullptr && y.radicand_ == nullptr)
            return x.rational_ * y.rational_;
        ExactNumber product(x.rational_ * y.rational_, x.rational_ * y.irrational_ + x.irrational_ * y.rational_, x, y);
        if (x.irrational_.sign() != 0 && y.irrational_.sign() != 0)
            product.rational_ += x.irrational_ * y.irrational_ * *product.radicand_;
        return product;
    }
    [[nodiscard]] ExactNumber times_power_of_two(int power) const {
        return {rational_.times_power_of_two(power), irrational_.times_power_of_two(power), *this, *this};
    }

    friend bool operator<(const ExactNumber& x, const ExactNumber& y) { return (x - y).sign() < 0; }
    friend bool operator>(const ExactNumber& x, const ExactNumber& y) { return y < x; }
    friend bool operator==(const ExactNumber& x, const ExactNumber& y) { return (x - y).sign() == 0; }

private:
    ExactNumber(Dyadic rational, Dyadic irrational, const ExactNumber& x, const ExactNumber& y)
        : rational_(std::move(rational)), irrational_(std::move(irrational)),
          radicand_(x.radicand_ != nullptr ? x.radicand_ : y.radicand_) {}

    Dyadic rational_;
    Dyadic irrational_;
    const Dyadic* radicand_ = nullptr;
};

} // namespace chasles::algebra
