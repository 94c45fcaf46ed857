// Error bounds of sums of products hold for every coefficient on every part, compared with exact rationals.
#include "chasles/algebra/sum_of_products.h"

#include "tests/support/random.h"
#include "tests/support/rational.h"

#include <gtest/gtest.h>

namespace chasles::algebra {
namespace {

using namespace test;

/// A computed cubic and the exact cubic. Each coefficient differs by at most the stated error.
template <class S>
struct Known {
    Bounded<3, S> computed;
    Bernstein<3, Rational> truth;
};

template <class S>
Known<S> random_known(Random& random, const Bernstein<3, S>& weight) {
    Known<S> known;
    const double size = std::ldexp(1.0, random.integer(-30, 30));
    known.computed.error = S(size * std::ldexp(random.uniform(0, 1), -random.integer(20, 60)));
    for (int i = 0; i <= 3; ++i) {
        known.computed.polynomial.set(i, S(size * random.uniform(-1, 1)));
        const Rational off = exact(known.computed.error) * exact(weight[i]) * Rational(random.uniform(-1, 1));
        known.truth.set(i, exact(known.computed.polynomial[i]) + off);
    }
    return known;
}

/// Largest error over bound of the coefficients on a random part.
template <class S>
double largest_ratio(Random& random) {
    Bernstein<3, S> weight;
    for (int i = 0; i <= 3; ++i)
        weight.set(i, S(random.uniform(0.5, 4)));
    SumOfProducts<S> sum;
    Bernstein<6, Rational> truth;
    for (int term = 0; term < 3; ++term) {
        const Known<S> a = random_known(random, weight);
        const Known<S> b = random_known(random, weight);
        sum.add(sized(a.computed, weight), sized(b.computed, weight));
        truth = truth + product(a.truth, b.truth);
    }
    const double from = random.uniform(0, 1);
    const double to = random.uniform(from, 1);
    const Bounded<6, S> bounded = sum.bounded();
    const auto there = restricted(bounded.polynomial, S(from), S(to));
    const auto truth_there = restricted(truth, Rational(from), Rational(to));
    const auto weight_there = restricted(product(exact(weight), exact(weight)), Rational(from), Rational(to));
    double largest = 0;
    for (int i = 0; i <= 6; ++i) {
        const Rational error = abs(Rational(exact(there[i]) - truth_there[i]));
        largest = std::max(largest, static_cast<double>(Rational(error / (exact(bounded.error) * weight_there[i]))));
    }
    return largest;
}

template <class S>
void expect_sound(std::uint32_t seed) {
    Random random(seed);
    double largest = 0;
    for (int trial = 0; trial < 3000; ++trial)
        largest = std::max(largest, largest_ratio<S>(random));
    EXPECT_LT(largest, 1);
    EXPECT_GT(largest, 0.2) << "the bound is too wide for this test to show anything";
}

TEST(SumOfProducts, BoundsHoldInDouble) {
    expect_sound<double>(921);
}
TEST(SumOfProducts, BoundsHoldInDoubleDouble) {
    expect_sound<DoubleDouble>(922);
}

} // namespace
} // namespace chasles::algebra
