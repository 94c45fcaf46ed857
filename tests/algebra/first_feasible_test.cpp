// first_feasible on problems that are built from a known answer.
#include "chasles/algebra/first_feasible.h"

#include "chasles/algebra/double_double.h"
#include "tests/support/exact_feasible.h"
#include "tests/support/random.h"

#include <gtest/gtest.h>

namespace chasles::algebra {
namespace {

using namespace test;

template <int Degree>
using Problem = OwnedProblem<Degree, Rational>;

template <int Degree>
Constraint<Degree, Rational> at_least_zero(const PowerPolynomial& p) {
    return {{bernstein_form<Degree>(p), 0}, {}, false};
}

template <int Degree>
Constraint<Degree, Rational> either(const PowerPolynomial& p, const PowerPolynomial& q) {
    return {{bernstein_form<Degree>(p), 0}, {bernstein_form<Degree>(q), 0}, true};
}

template <int Degree>
Problem<Degree> problem(const PowerPolynomial& function, std::vector<Constraint<Degree, Rational>> constraints = {}) {
    Problem<Degree> result;
    result.function.polynomial = bernstein_form<Degree>(function);
    result.constraints = std::move(constraints);
    return result;
}

/// tau - root, and its negative.
PowerPolynomial after(const Rational& root) {
    return {Rational(-root), Rational(1)};
}
PowerPolynomial before(const Rational& root) {
    return {root, Rational(-1)};
}

/// `slack`: bound on how far rounded coefficients move the root.
template <class S, int Degree>
void expect_first_in(const Problem<Degree>& exactly, const Rational& tau, double slack) {
    const auto found = in_scalar<S>(exactly).solve();
    ASSERT_TRUE(found) << "missed " << tau;
    EXPECT_LE(Rational(found->lower), tau + Rational(slack));
    EXPECT_GE(Rational(found->upper), tau - Rational(slack));
    EXPECT_LE(found->upper - found->lower, 1.001e-12 + 2 * slack);
}

/// In all three scalars. A root of multiplicity k moves by the k-th root of the rounding.
template <int Degree>
void expect_first(const Problem<Degree>& exactly, const Rational& tau, int multiplicity = 1) {
    expect_first_in<Rational>(exactly, tau, 0);
    expect_first_in<double>(exactly, tau, 100 * std::pow(0x1p-50, 1.0 / multiplicity));
    expect_first_in<DoubleDouble>(exactly, tau, 100 * std::pow(0x1p-98, 1.0 / multiplicity));
}

template <int Degree>
void expect_none(const Problem<Degree>& exactly) {
    EXPECT_FALSE(exactly.solve());
    EXPECT_FALSE(in_scalar<double>(exactly).solve());
    EXPECT_FALSE(in_scalar<DoubleDouble>(exactly).solve());
}

TEST(FirstFeasible, FindsASimpleRootOfEveryDegree) {
    for_degrees<1, 6>([](auto degree) {
        std::vector<Rational> roots{ratio(1, 3)};
        for (int i = 1; i < degree(); ++i)
            roots.push_back(ratio(i % 2 == 0 ? 4 : -3, i + 1));
        expect_first(problem<degree()>(from_roots(roots, 2)), ratio(1, 3));
    });
}

TEST(FirstFeasible, FindsTheFirstOfManyRoots) {
    for_degrees<2, 6>([](auto degree) {
        std::vector<Rational> roots;
        for (int i = 0; i < degree(); ++i)
            roots.push_back(ratio(2 * i + 1, 13));
        expect_first(problem<degree()>(from_roots(roots, -5)), ratio(1, 13));
    });
}

TEST(FirstFeasible, SimpleRootInsideIsCertain) {
    const auto cubic =
        problem<3>(from_roots({ratio(1, 3), ratio(3, 4), 2}, 1), {at_least_zero<3>(before(ratio(1, 2)))});
    EXPECT_TRUE(cubic.solve()->certain);
    EXPECT_TRUE(in_scalar<double>(cubic).solve()->certain);
    EXPECT_TRUE(in_scalar<DoubleDouble>(cubic).solve()->certain);
}

TEST(FirstFeasible, DoubleRootsAreContacts) {
    expect_first(problem<2>(from_roots({ratio(1, 2), ratio(1, 2)}, 1)), ratio(1, 2), 2);
    expect_first(problem<3>(from_roots({ratio(1, 3), ratio(1, 3), 2}, 1)), ratio(1, 3), 2);
    expect_first(problem<6>(from_roots({ratio(2, 7), ratio(2, 7), 2, 3, 2, 3}, 1)), ratio(2, 7), 2);
}

TEST(FirstFeasible, TripleRootsAreContacts) {
    expect_first(problem<3>(from_roots({ratio(1, 2), ratio(1, 2), ratio(1, 2)}, 8)), ratio(1, 2), 3);
    expect_first(problem<3>(from_roots({ratio(1, 3), ratio(1, 3), ratio(1, 3)}, 1)), ratio(1, 3), 3);
}

TEST(FirstFeasible, RootAtZeroIsReportedAtZero) {
    const auto cubic = problem<3>(from_roots({0, ratio(1, 2), -1}, 1));
    expect_first(cubic, 0);
    EXPECT_EQ(in_scalar<double>(cubic).solve()->lower, 0);
    expect_first(problem<3>(from_roots({0, 0, 2}, 1)), 0, 2);
}

TEST(FirstFeasible, RootAtOneIsReportedAtOne) {
    const auto cubic = problem<3>(from_roots({1, -1, 2}, 1));
    expect_first(cubic, 1);
    EXPECT_EQ(in_scalar<double>(cubic).solve()->upper, 1);
    expect_first(problem<3>(from_roots({1, 1, 1}, 1)), 1, 3);
}

TEST(FirstFeasible, RootsOutsideAreNone) {
    expect_none(problem<3>(from_roots({ratio(-1, 1000), ratio(1001, 1000), 5}, 1)));
    expect_none(problem<6>(from_roots({-1, -2, 2, 3, 4, ratio(11, 10)}, 1)));
}

TEST(FirstFeasible, ComplexRootsAreNone) {
    // (2 tau - 1)^2 + 1e-6: at least a millionth above zero.
    expect_none(problem<2>({Rational(1) + ratio(1, 1000000), Rational(-4), Rational(4)}));
}

TEST(FirstFeasible, ZeroFunctionLeavesTheChoiceToTheConstraints) {
    expect_first(problem<3>({}), 0);
    expect_first(problem<3>({}, {at_least_zero<3>(after(ratio(1, 4)))}), ratio(1, 4));
    expect_first(problem<3>({}, {at_least_zero<3>(after(ratio(1, 4))), at_least_zero<3>(after(ratio(2, 3)))}),
                 ratio(2, 3));
    expect_none(problem<3>({}, {at_least_zero<3>(after(ratio(2, 3))), at_least_zero<3>(before(ratio(1, 2)))}));
    expect_none(problem<3>({}, {at_least_zero<3>({Rational(-1)})}));
}

TEST(FirstFeasible, ConstraintsExcludeRootsInTurn) {
    const PowerPolynomial function = from_roots({ratio(1, 4), ratio(1, 2), ratio(3, 4)}, 1);
    const auto not_the_first = at_least_zero<3>(after(ratio(3, 8)));
    const auto not_the_second = at_least_zero<3>(from_roots({ratio(7, 16), ratio(9, 16)}, 1));
    const auto not_the_third = at_least_zero<3>(before(ratio(5, 8)));
    expect_first(problem<3>(function), ratio(1, 4));
    expect_first(problem<3>(function, {not_the_first}), ratio(1, 2));
    expect_first(problem<3>(function, {not_the_second}), ratio(1, 4));
    expect_first(problem<3>(function, {not_the_first, not_the_second}), ratio(3, 4));
    expect_none(problem<3>(function, {not_the_first, not_the_second, not_the_third}));
}

TEST(FirstFeasible, AnAlternativeIsEnough) {
    const PowerPolynomial function = from_roots({ratio(1, 4), ratio(3, 4)}, 1);
    const PowerPolynomial never{Rational(-1)};
    expect_first(problem<3>(function, {either<3>(never, before(ratio(1, 2)))}), ratio(1, 4));
    expect_first(problem<3>(function, {either<3>(before(ratio(1, 2)), never)}), ratio(1, 4));
    expect_first(problem<3>(function, {either<3>(never, after(ratio(1, 2)))}), ratio(3, 4));
    expect_none(problem<3>(function, {either<3>(never, never)}));
    expect_none(problem<3>(function, {either<3>(before(ratio(1, 8)), after(ratio(7, 8)))}));
}

TEST(FirstFeasible, ConstraintsAreClosed) {
    expect_first(problem<3>(after(ratio(1, 4)), {at_least_zero<3>(after(ratio(1, 4)))}), ratio(1, 4));
    expect_first(problem<3>(after(ratio(1, 4)), {at_least_zero<3>(before(ratio(1, 4)))}), ratio(1, 4));
}

TEST(FirstFeasible, TinyMissesAreToldFromContactsInRationals) {
    const Rational tiny(1e-11); // ten tolerances
    expect_first_in<Rational>(problem<1>(after(ratio(1, 4)), {at_least_zero<1>(before(ratio(1, 4) + tiny))}),
                              ratio(1, 4), 0);
    EXPECT_FALSE(problem<1>(after(ratio(1, 4)), {at_least_zero<1>(before(ratio(1, 4) - tiny))}).solve());
}

TEST(FirstFeasible, DoubleDoubleTellsMissesThatDoublesCannot) {
    const Rational tiny(1e-20);
    const auto miss = problem<1>(after(ratio(1, 4)), {at_least_zero<1>(before(ratio(1, 4) - tiny))});
    const auto in_doubles = in_scalar<double>(miss).solve({1e-12, 1e-12});
    ASSERT_TRUE(in_doubles) << "doubles cannot decide, so a contact must be reported";
    EXPECT_FALSE(in_doubles->certain);
    EXPECT_FALSE(in_scalar<DoubleDouble>(miss).solve({1e-12, 0x1p-90}));
}

TEST(FirstFeasible, ToleranceSetsTheWidthOfTheBracket) {
    const auto cubic = in_scalar<double>(problem<3>(from_roots({ratio(1, 3), 2, -1}, 1)));
    for (const double width : {1e-2, 1e-6, 1e-12}) {
        const auto found = cubic.solve({width, width});
        ASSERT_TRUE(found);
        EXPECT_LE(found->upper - found->lower, 1.001 * width);
        EXPECT_LE(Rational(found->lower), ratio(1, 3) + Rational(1e-15));
        EXPECT_GE(Rational(found->upper), ratio(1, 3) - Rational(1e-15));
    }
}

TEST(FirstFeasible, UnevenWeightsDoNotMoveTheRoot) {
    auto weighted = problem<3>(from_roots({ratio(1, 3), 2, -1}, 1));
    for (int i = 0; i <= 3; ++i)
        weighted.weight.set(i, 1 + 5 * i * i);
    const auto found = weighted.solve();
    ASSERT_TRUE(found);
    EXPECT_LE(Rational(found->lower), ratio(1, 3));
    EXPECT_GE(Rational(found->upper), ratio(1, 3));
}

TEST(FirstFeasible, NearMissWithinTheBandIsReportedAsUncertain) {
    OwnedProblem<3, double> near;
    near.function = {Bernstein<3, double>::constant(1e-9), 2e-9};
    const auto found = near.solve();
    ASSERT_TRUE(found);
    EXPECT_EQ(found->lower, 0);
    EXPECT_FALSE(found->certain);
    near.function.error = 5e-10;
    EXPECT_FALSE(near.solve());
}

TEST(FirstFeasible, BandOfTheConstraintIsGivenTheBenefitOfTheDoubt) {
    OwnedProblem<3, double> near = in_scalar<double>(problem<3>(after(ratio(1, 4))));
    near.constraints.push_back({{Bernstein<3, double>::constant(-1e-9), 2e-9}, {}, false});
    const auto found = near.solve();
    ASSERT_TRUE(found);
    EXPECT_FALSE(found->certain);
    near.constraints[0].first.error = 5e-10;
    EXPECT_FALSE(near.solve());
}

TEST(FirstFeasibleGuess, BracketIsAsNarrowAsTheBand) {
    auto line = in_scalar<double>(problem<3>(before(ratio(1, 3))));
    line.function.error = 1e-9;
    const auto found = line.solve();
    ASSERT_TRUE(found && found->certain);
    EXPECT_LE(found->lower, 1.0 / 3 - 1e-9);
    EXPECT_GE(found->upper, 1.0 / 3 + 1e-9);
    EXPECT_LE(found->upper - found->lower, 2.6e-9);
}

TEST(FirstFeasibleGuess, AnEarlierRootIsNotJumpedOver) {
    test::Random random(571);
    int jumps = 0;
    for (int trial = 0; trial < 2000; ++trial) {
        std::vector<double> roots{random.uniform(0.05, 0.95), random.uniform(0.05, 0.95), random.uniform(0.05, 0.95)};
        std::sort(roots.begin(), roots.end());
        if (roots[1] - roots[0] < 1e-3)
            continue;
        const auto three = in_scalar<double>(
            problem<3>(from_roots({Rational(roots[0]), Rational(roots[1]), Rational(roots[2])}, random.scaled(-2, 2))));
        const Focus focus{0, random.uniform(0.1, 0.99)}; // the guess begins in its middle
        const auto guess = crossing_near(three.function.polynomial, 0.5 * focus.upper);
        jumps += guess && guess->tau > roots[0] + 1e-3 ? 1 : 0;
        const auto found = three.solve({1e-12, 1e-12, 10'000, focus});
        ASSERT_TRUE(found);
        EXPECT_NEAR(found->lower, roots[0], 1e-9);
        EXPECT_LE(found->lower, roots[0] + 1e-12);
    }
    EXPECT_GT(jumps, 200);
}

TEST(FirstFeasibleGuess, AForbiddenRootIsPassedOver) {
    const auto late = at_least_zero<3>(after(ratio(1, 2)));
    expect_none(problem<3>({ratio(-1, 4), 1}, {late}));
    expect_first(problem<3>(from_roots({ratio(1, 4), ratio(3, 4), 2}, 1), {late}), ratio(3, 4));
    expect_none(
        problem<3>(from_roots({ratio(1, 4), ratio(3, 4), 2}, 1), {late, at_least_zero<3>(before(ratio(2, 3)))}));
}

/// (tau - root) / 100, with a weight of 1 but for one coefficient.
std::optional<FeasibleInterval> first_of_rising(const Rational& root, int heavy, double weight, double error) {
    auto rising = in_scalar<double>(problem<3>({Rational(-root) * ratio(1, 100), ratio(1, 100)}));
    for (int i = 0; i <= 3; ++i)
        rising.weight.set(i, i == heavy ? weight : 1.0);
    rising.function.error = error;
    return rising.solve();
}

TEST(FirstFeasibleGuess, MonotoneFunctionsOfLargeWeightAreNotTakenForFree) {
    // Within the band near 0, where the weight is large: the exact F may vanish before it crosses zero at 3/4.
    const auto found = first_of_rising(ratio(3, 4), 0, 100, 1e-4);
    ASSERT_TRUE(found);
    EXPECT_EQ(found->lower, 0);
}

TEST(FirstFeasibleGuess, TheLargestWeightCountsWhereverItIs) {
    // Within the band around 1/3, where the weight is large: the exact F may vanish long before it crosses zero.
    const auto found = first_of_rising(ratio(999, 1000), 1, 1e4, 5e-6);
    ASSERT_TRUE(found);
    EXPECT_LE(found->lower, 0.5);
}

/// From a guess that has not converged, the step in double-double leaves [0, 1].
TEST(FirstFeasibleGuess, AStepOutsideIsNoGuess) {
    const auto found = [](const std::array<double, 4>& coefficients, const Focus& focus) {
        OwnedProblem<3, DoubleDouble> problem;
        problem.weight = Bernstein<3, DoubleDouble>::constant(DoubleDouble(1));
        for (int i = 0; i < 4; ++i)
            problem.function.polynomial.set(i, DoubleDouble(coefficients[std::size_t(i)]));
        return problem.solve({1e-12, 0x1p-90, 10'000, focus});
    };
    const auto at_the_end =
        found({0x1.5d22a387f893p-21, 0x1.d183851e4944bp-23, 0x1.a3f757f79a763p-49, -0x1.24c70bf51061p-87}, {});
    ASSERT_TRUE(at_the_end);
    EXPECT_LE(at_the_end->lower, at_the_end->upper);
    EXPECT_LE(at_the_end->upper, 1);
    const auto at_the_start =
        found({0x1.5701cc237ec14p-57, 0x1.1976a8c7c6c28p-32, -0x1.bc780ba53514bp-17, -0x1.4d5baeede4a57p-15},
              {0, 0x1.dab5045a212d8p-16});
    ASSERT_TRUE(at_the_start);
    EXPECT_GT(at_the_start->lower, 0);
    EXPECT_LE(at_the_start->lower, at_the_start->upper);
}

} // namespace
} // namespace chasles::algebra
