// Bernstein forms represent their polynomials exactly in rationals, and within the stated error in other scalars.
#include "chasles/algebra/bernstein.h"

#include "chasles/algebra/unit_roundoff.h"
#include "tests/support/power_polynomial.h"
#include "tests/support/random.h"

#include <limits>

namespace chasles::algebra {
namespace {

using namespace test;

template <int Degree>
Bernstein<Degree, Rational> random_polynomial(Random& random) {
    Bernstein<Degree, Rational> p;
    for (int i = 0; i <= Degree; ++i)
        p.set(i, ratio(random.integer(-9, 9), random.integer(1, 7)));
    return p;
}

template <int Degree>
Bernstein<Degree, double> random_doubles(Random& random) {
    Bernstein<Degree, double> p;
    for (int i = 0; i <= Degree; ++i)
        p.set(i, random.scaled(-3, 0));
    return p;
}

Rational random_tau(Random& random) {
    return ratio(random.integer(0, 60), 60);
}

TEST(Bernstein, ValueIsThatOfThePowerBasis) {
    Random random(101);
    for_degrees<1, 6>([&](auto degree) {
        for (int trial = 0; trial < 50; ++trial) {
            const auto p = random_polynomial<degree()>(random);
            const Rational tau = random_tau(random);
            EXPECT_EQ(value_at(p, tau), value(power_form(p), tau));
        }
    });
}

TEST(Bernstein, PowerBasisRoundTrips) {
    Random random(102);
    for_degrees<1, 6>([&](auto degree) {
        const auto p = random_polynomial<degree()>(random);
        const auto again = bernstein_form<degree()>(power_form(p));
        for (int i = 0; i <= degree(); ++i)
            EXPECT_EQ(again[i], p[i]);
    });
}

TEST(Bernstein, RestrictionIsSubstitutionExactly) {
    Random random(103);
    for_degrees<1, 6>([&](auto degree) {
        for (int trial = 0; trial < 50; ++trial) {
            const auto p = random_polynomial<degree()>(random);
            const Rational from = random_tau(random);
            const Rational to = random_tau(random);
            const PowerPolynomial line = trimmed({from, Rational(to - from)});
            EXPECT_EQ(power_form(restricted(p, from, to)), composed(power_form(p), line));
        }
    });
}

TEST(Bernstein, RestrictionToTheWholeIntervalChangesNothing) {
    Random random(104);
    const auto p = random_doubles<3>(random);
    const auto same = restricted(p, 0.0, 1.0);
    for (int i = 0; i <= 3; ++i)
        EXPECT_EQ(same[i], p[i]);
}

TEST(Bernstein, ProductMultipliesThePolynomials) {
    Random random(105);
    for_degrees<0, 4>([&](auto left) {
        for_degrees<0, 4>([&](auto right) {
            const auto a = random_polynomial<left()>(random);
            const auto b = random_polynomial<right()>(random);
            EXPECT_EQ(power_form(product(a, b)), multiplied(power_form(a), power_form(b)));
        });
    });
}

TEST(Bernstein, ElevationKeepsThePolynomial) {
    Random random(106);
    for_degrees<0, 3>([&](auto degree) {
        const auto p = random_polynomial<degree()>(random);
        EXPECT_EQ(power_form(elevated<degree() + 1>(p)), power_form(p));
        EXPECT_EQ(power_form(elevated<degree() + 3>(p)), power_form(p));
    });
}

TEST(Bernstein, SumsAndMultiplesAreThoseOfThePolynomials) {
    Random random(107);
    const auto a = random_polynomial<3>(random);
    const auto b = random_polynomial<3>(random);
    EXPECT_EQ(power_form(a + b), sum(power_form(a), power_form(b)));
    EXPECT_EQ(power_form(a - b), sum(power_form(a), scaled(power_form(b), Rational(-1))));
    EXPECT_EQ(power_form(Rational(3) * a), scaled(power_form(a), Rational(3)));
}

TEST(Bernstein, BinomialsAreThoseOfPascalsTriangle) {
    for (int n = 1; n <= 12; ++n)
        for (int k = 1; k < n; ++k)
            EXPECT_EQ(binomial(n, k), binomial(n - 1, k - 1) + binomial(n - 1, k));
    EXPECT_EQ(binomial(6, 3), 20);
}

/// The largest ratio of the error of value_at and restricted to the bound stated in their comments.
template <int Degree, class S>
double rounding_ratio(Random& random) {
    const auto p = random_doubles<Degree>(random);
    const auto in_scalar = converted<S>(p);
    const auto in_rationals = test::exact(p);
    const double from = random.chance(0.2) ? 0.0 : random.uniform(0, 1);
    const double to = random.chance(0.2) ? 1.0 : random.uniform(from, 1);
    const Rational unit = Rational(unit_roundoff<S>) * largest_coefficient(in_rationals);
    const Rational value_error =
        test::magnitude(test::exact(value_at(in_scalar, S(to))) - value_at(in_rationals, Rational(to)));
    Rational worst = value_error / (unit * (3 * Degree));
    const auto part = test::exact(restricted(in_scalar, S(from), S(to)));
    const auto true_part = restricted(in_rationals, Rational(from), Rational(to));
    for (int i = 0; i <= Degree; ++i)
        worst = std::max<Rational>(worst, test::magnitude(part[i] - true_part[i]) / (unit * restriction_units<Degree>));
    return static_cast<double>(worst);
}

TEST(Bernstein, RoundingStaysWithinItsBounds) {
    Random random(108);
    double largest = 0;
    for_degrees<1, 6>([&](auto degree) {
        for (int trial = 0; trial < 1000; ++trial)
            largest = std::max(
                {largest, rounding_ratio<degree(), double>(random), rounding_ratio<degree(), DoubleDouble>(random)});
    });
    std::cout << "largest error over bound " << largest << "\n";
    EXPECT_LE(largest, 1);
    EXPECT_GT(largest, 0.05) << "the bound is too wide for this test to show anything";
}

TEST(Bernstein, ValuesLieBetweenTheSmallestAndTheLargestCoefficient) {
    Random random(109);
    for (int trial = 0; trial < 200; ++trial) {
        const auto p = random_polynomial<3>(random);
        const Rational at = value_at(p, random_tau(random));
        EXPECT_LE(at, std::max({p[0], p[1], p[2], p[3]}));
        EXPECT_GE(at, std::min({p[0], p[1], p[2], p[3]}));
    }
}

TEST(BernsteinSign, IsProvenOnlyBeyondTheError) {
    const auto error = Bernstein<3, double>::constant(0.5);
    auto p = Bernstein<3, double>::constant(0.75);
    EXPECT_TRUE(is_positive(p, error));
    EXPECT_FALSE(is_negative(p, error));
    EXPECT_TRUE(is_negative(p * -1.0, error));
    for (int lane = 0; lane <= 3; ++lane) {
        auto touched = p;
        touched.set(lane, 0.5);
        EXPECT_FALSE(is_positive(touched, error)) << "lane " << lane << " is at its error, not beyond";
        EXPECT_FALSE(is_negative(touched * -1.0, error));
    }
}

TEST(BernsteinSign, OfNotANumberIsNeverProven) {
    const auto error = Bernstein<3, double>::constant(0);
    for (int lane = 0; lane <= 3; ++lane) {
        auto p = Bernstein<3, double>::constant(1);
        p.set(lane, std::numeric_limits<double>::quiet_NaN());
        EXPECT_FALSE(is_positive(p, error));
        EXPECT_FALSE(is_negative(p, error));
    }
}

TEST(BernsteinSign, ProvenMeansNoRoot) {
    Random random(110);
    int proven = 0;
    for (int trial = 0; trial < 2000; ++trial) {
        const auto p = random_polynomial<3>(random);
        const auto none = Bernstein<3, Rational>();
        if (!is_positive(p, none) && !is_negative(p, none))
            continue;
        ++proven;
        const int sign = is_positive(p, none) ? 1 : -1;
        for (int i = 0; i <= 20; ++i)
            EXPECT_EQ(value(power_form(p), ratio(i, 20)).sign(), sign);
    }
    EXPECT_GT(proven, 100);
}

} // namespace
} // namespace chasles::algebra
