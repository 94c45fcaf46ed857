// The exact form of first_feasible against Sturm's theorem: every case is decided.
#include "chasles/algebra/exact_feasible.h"

#include "tests/support/exact_numbers.h"
#include "tests/support/random_problems.h"

namespace chasles::algebra {
namespace {

using namespace test;

template <int Degree>
OwnedProblem<Degree, ExactNumber> whole_multiples(const OwnedProblem<Degree, Rational>& problem) {
    OwnedProblem<Degree, ExactNumber> result;
    result.function = {whole_multiple(problem.function.polynomial), ExactNumber(0)};
    for (const auto& constraint : problem.constraints) {
        const Rational span = constraint.span.value_or(Rational(0));
        const Rational multiple = common_denominator(constraint.first.polynomial) *
                                  common_denominator(constraint.second.polynomial) * Rational(denominator(span));
        result.constraints.push_back({{whole_multiple(constraint.first.polynomial, multiple), ExactNumber(0)},
                                      {whole_multiple(constraint.second.polynomial, multiple), ExactNumber(0)},
                                      constraint.has_alternative,
                                      constraint.span ? std::optional(exact_number(span * multiple)) : std::nullopt});
    }
    return result;
}

TEST(ExactFeasible, DecidesEveryRandomProblem) {
    Random random(731);
    int contacts = 0, misses = 0, vanishing = 0;
    for_degrees<1, 6>([&](auto degree) {
        for (int trial = 0; trial < 150; ++trial) {
            const auto problem = random_problem<degree()>(random);
            const auto truth = first_feasible_exactly(problem);
            const auto found = whole_multiples(problem).solve();
            ASSERT_EQ(found.has_value(), truth.has_value());
            (found ? contacts : misses) += 1;
            vanishing += test::power_form(problem.function.polynomial).empty() ? 1 : 0;
            if (!found)
                continue;
            EXPECT_TRUE(found->certain);
            EXPECT_LE(Rational(found->lower), truth->upper);
            EXPECT_GE(Rational(found->upper), truth->lower);
            EXPECT_LE(found->upper - found->lower, 1e-12);
            EXPECT_EQ(found->lower == 0, truth->upper == 0) << "at the start only if exactly there";
        }
    });
    EXPECT_GT(contacts, 250);
    EXPECT_GT(misses, 150);
    EXPECT_GT(vanishing, 20);
}

TEST(ExactFeasible, ATouchWithoutCrossingIsCertain) {
    OwnedProblem<2, Rational> problem;
    problem.function.polynomial = test::bernstein_form<2>(from_roots({ratio(1, 3), ratio(1, 3)}, 1));
    const auto found = whole_multiples(problem).solve();
    ASSERT_TRUE(found);
    EXPECT_TRUE(found->certain);
    EXPECT_LE(Rational(found->lower), ratio(1, 3));
    EXPECT_GE(Rational(found->upper), ratio(1, 3));
}

/// F vanishes identically. The two sides of a constraint become feasible at nearly the same tau, listed in either
/// order.
TEST(ExactFeasible, TheFirstOfTwoPlacesNextToEachOtherIsFound) {
    using Integer = boost::multiprecision::mpz_int;
    const Rational tiny(Integer(1), Integer(1) << 130);
    for (const Rational& place : {tiny, ratio(1, 3)}) {
        for (const bool swapped : {false, true}) {
            const auto opens = test::bernstein_form<1>({Rational(-place), Rational(1)});
            const auto opens_later = test::bernstein_form<1>({Rational(-place - 1000 * tiny), Rational(1)});
            OwnedProblem<1, Rational> problem;
            problem.constraints.push_back(
                {{swapped ? opens_later : opens, 0}, {swapped ? opens : opens_later, 0}, true});
            const auto found = whole_multiples(problem).solve();
            ASSERT_TRUE(found);
            EXPECT_TRUE(found->certain);
            EXPECT_GT(found->lower, 0);
            EXPECT_LE(Rational(found->lower), place);
            EXPECT_GE(Rational(found->upper), place);
        }
    }
}

TEST(ExactFeasible, AMissByNextToNothingIsAMiss) {
    for (const int exponent : {-100, -300, -1000}) {
        OwnedProblem<2, Rational> problem;
        const PowerPolynomial touch = from_roots({ratio(1, 3), ratio(1, 3)}, 1);
        problem.function.polynomial = test::bernstein_form<2>(sum(touch, {power_of_two(exponent)}));
        EXPECT_FALSE(whole_multiples(problem).solve()) << exponent;
        problem.function.polynomial = test::bernstein_form<2>(sum(touch, {Rational(-power_of_two(exponent))}));
        EXPECT_TRUE(whole_multiples(problem).solve()) << exponent;
    }
}

TEST(ExactFeasible, AFunctionKnownToWithinAnErrorIsNotCertain) {
    OwnedProblem<1, ExactNumber> problem;
    problem.weight = Bernstein<1, ExactNumber>::constant(ExactNumber(1));
    problem.function.polynomial.set(0, ExactNumber(4));
    problem.function.polynomial.set(1, ExactNumber(-4));
    problem.function.error = ExactNumber(1);
    const auto found = problem.solve();
    ASSERT_TRUE(found);
    EXPECT_FALSE(found->certain);
    EXPECT_EQ(found->lower, 0.375) << "where |4 - 8 tau| <= 1 begins to hold";
}

} // namespace
} // namespace chasles::algebra
