// A guess has no guarantee, but it must be accurate on simple problems to be useful.
#include "chasles/algebra/crossing_guess.h"

#include "tests/support/exact_feasible.h"
#include "tests/support/random.h"

#include <gtest/gtest.h>

namespace chasles::algebra {
namespace {

using namespace test;

/// slope (tau - root) + slope curvature (tau - root)^2, times 1 for certain degrees.
template <int Degree>
Bernstein<Degree, double> parabola(double root, double slope, double curvature) {
    const PowerPolynomial shifted{Rational(-root), Rational(1)};
    const PowerPolynomial outer{Rational(0), Rational(slope), Rational(slope) * Rational(curvature)};
    return rounded_to<double>(bernstein_form<Degree>(composed(outer, shifted)));
}

TEST(CrossingGuess, IsNextToAPlainRoot) {
    Random random(561);
    for (int trial = 0; trial < 300; ++trial) {
        const double root = random.uniform(0.05, 0.95);
        const double slope = random.scaled(-3, 3);
        const double curvature = random.uniform(-0.4, 0.4); // no other root in [0, 1]
        const auto guess = first_crossing(parabola<3>(root, slope, curvature));
        ASSERT_TRUE(guess);
        EXPECT_NEAR(guess->tau, root, 1e-14);
        EXPECT_NEAR(guess->slope, slope, 1e-4 * std::abs(slope));
        EXPECT_NEAR(guess->curvature, curvature, 1e-4);
        EXPECT_NEAR(first_crossing(parabola<6>(root, slope, curvature))->tau, root, 1e-13);
    }
}

TEST(CrossingGuess, NoneWithoutAChangeOfSign) {
    EXPECT_FALSE(first_crossing(rounded_to<double>(bernstein_form<3>({Rational(1), Rational(2)}))));
    EXPECT_FALSE(first_crossing(Bernstein<3, double>()));
}

TEST(CrossingGuess, NoneWhereStepsLeaveTheInterval) {
    EXPECT_FALSE(crossing_near(parabola<3>(1.5, 1, 0), 0.5));
    EXPECT_FALSE(crossing_near(Bernstein<3, double>::constant(1), 0.5));
}

TEST(CrossingGuess, BeginsWhereItIsTold) {
    const auto two_roots = rounded_to<double>(bernstein_form<3>(from_roots({ratio(1, 4), ratio(3, 4)}, 1)));
    EXPECT_NEAR(crossing_near(two_roots, 0.3)->tau, 0.25, 1e-14);
    EXPECT_NEAR(crossing_near(two_roots, 0.7)->tau, 0.75, 1e-14);
}

} // namespace
} // namespace chasles::algebra
