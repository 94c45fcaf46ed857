// first_feasible against Sturm's theorem in exact rationals, on random problems with many corner cases.
#include "chasles/algebra/first_feasible.h"

#include "chasles/algebra/double_double.h"
#include "tests/support/exact_feasible.h"
#include "tests/support/random_problems.h"

namespace chasles::algebra {
namespace {

using namespace test;

struct Tally {
    int problems = 0;
    int contacts = 0;
    int certain = 0;
    int doubtful = 0; ///< uncertain contacts where there is no contact

    void expect_hit_rates() const {
        std::cout << contacts << " contacts of " << problems << ", " << certain << " certain, " << doubtful
                  << " doubtful\n";
        EXPECT_GT(contacts, problems / 5);
        EXPECT_GT(problems - contacts, problems / 10);
        EXPECT_GT(certain, contacts / 3);
        EXPECT_LT(doubtful, problems / 10);
    }
};

/// A bracket may be wide only if F is within a few error bounds of zero in the bracket.
template <int Degree, class S>
void expect_blurred(const OwnedProblem<Degree, S>& problem, const FeasibleInterval& found) {
    const Rational at_lower = value_at(test::exact(problem.function.polynomial), Rational(found.lower));
    EXPECT_LE(test::magnitude(at_lower), 4 * test::exact(problem.function.error))
        << "wide for no reason: " << found.lower << " to " << found.upper;
}

/// Any valid focus.
Focus random_focus(const std::optional<AlgebraicRoot>& truth, Random& random) {
    const double last = truth ? std::max(0.0, detail::rounded_down(truth->lower)) : 1;
    const double lower = random.chance(0.3) ? last : random.uniform(0, last);
    return {lower, random.chance(0.3) ? lower : random.uniform(lower, 1)};
}

/// An answer is never late; a certain answer is true and its bracket is narrow.
template <int Degree, class S>
void expect_promises(const OwnedProblem<Degree, S>& problem, const std::optional<AlgebraicRoot>& truth,
                     const std::optional<FeasibleInterval>& found, Tally& tally) {
    ++tally.problems;
    if (!truth) {
        EXPECT_FALSE(found && found->certain) << "certain, but there is no contact";
        tally.doubtful += found ? 1 : 0;
        return;
    }
    ++tally.contacts;
    ASSERT_TRUE(found) << "missed the contact at " << static_cast<double>(truth->upper);
    EXPECT_LE(Rational(found->lower), truth->upper) << "late";
    if (!found->certain)
        return;
    ++tally.certain;
    EXPECT_GE(Rational(found->upper), truth->lower) << "the first contact is after the bracket";
    if (found->upper - found->lower > 1.001e-12)
        expect_blurred(problem, *found);
}

/// Rational coefficients are used exactly. Rounded coefficients define the problem after rounding.
template <class S>
void expect_promises_for_random_problems(std::uint64_t seed, int trials, bool next_to_an_end = false) {
    Random random(seed);
    Tally tally;
    for_degrees<1, 6>([&](auto degree) {
        for (int trial = 0; trial < trials; ++trial) {
            const RootPlaces places = next_to_an_end ? RootPlaces::next_to_an_end(random) : RootPlaces();
            const auto problem = in_scalar<S>(random_problem<degree()>(random, places));
            const auto truth = first_feasible_exactly(problem);
            expect_promises(problem, truth, problem.solve(), tally);
            Tolerance focused;
            focused.focus = random_focus(truth, random);
            expect_promises(problem, truth, problem.solve(focused), tally);
        }
    });
    tally.expect_hit_rates();
}

TEST(FirstFeasibleRandom, DoublesKeepThePromises) {
    expect_promises_for_random_problems<double>(501, 250);
}
TEST(FirstFeasibleRandom, DoubleDoublesKeepThePromises) {
    expect_promises_for_random_problems<DoubleDouble>(502, 120);
}
/// Problems with poor guesses: slopes change within a part of [0, 1] that is far smaller than the steps of the guess.
TEST(FirstFeasibleRandom, DoublesKeepThePromisesNextToTheEnds) {
    expect_promises_for_random_problems<double>(506, 250, true);
}
TEST(FirstFeasibleRandom, DoubleDoublesKeepThePromisesNextToTheEnds) {
    expect_promises_for_random_problems<DoubleDouble>(507, 250, true);
}
TEST(FirstFeasibleRandom, RationalsKeepThePromises) {
    expect_promises_for_random_problems<Rational>(503, 60);
}

/// Rationals have no error bands: a reported contact exists, or the constraints are violated by a tiny amount.
TEST(FirstFeasibleRandom, RationalBracketsEncloseTheFirstContactEvenWhenUncertain) {
    Random random(504);
    int uncertain = 0;
    for (int trial = 0; trial < 400; ++trial) {
        const auto problem = random_problem<3>(random);
        const auto truth = first_feasible_exactly(problem);
        const auto found = problem.solve();
        if (!truth || !found || found->certain)
            continue;
        ++uncertain;
        EXPECT_LE(found->upper - found->lower, 1.001e-12);
        EXPECT_LE(Rational(found->lower), truth->upper);
    }
    EXPECT_GT(uncertain, 10);
}

/// A random polynomial within the error band of `p`.
template <int Degree>
Bernstein<Degree, Rational> perturbed(const Bounded<Degree, double>& p, Random& random) {
    Bernstein<Degree, Rational> result = test::exact(p.polynomial);
    for (int i = 0; i <= Degree; ++i) {
        const double share = random.chance(0.3) ? (random.chance(0.5) ? 1.0 : -1.0) : random.uniform(-1, 1);
        result.set(i, result[i] + Rational(p.error) * Rational(share));
    }
    return result;
}

TEST(FirstFeasibleRandom, PromisesHoldForEveryPolynomialWithinTheBands) {
    Random random(505);
    int contacts = 0;
    int certain = 0;
    for (int trial = 0; trial < 1500; ++trial) {
        auto banded = in_scalar<double>(random_problem<3>(random));
        const double band = random.scaled(-10, -3);
        banded.function.error += std::abs(band);
        for (auto& constraint : banded.constraints)
            constraint.first.error += std::abs(band) * random.uniform(0, 3);
        auto truth = OwnedProblem<3, Rational>();
        truth.function.polynomial = perturbed(OwnedProblem<3, double>(banded).function, random);
        for (const auto& constraint : banded.constraints)
            truth.constraints.push_back({{perturbed(constraint.first, random), 0},
                                         {test::exact(constraint.second.polynomial), 0},
                                         constraint.has_alternative,
                                         constraint.span ? std::optional(Rational(*constraint.span)) : std::nullopt});
        const auto root = first_feasible_exactly(truth);
        const auto found = banded.solve({500 * std::abs(band), 1e-12});
        if (found && found->certain) {
            ++certain;
            ASSERT_TRUE(root) << "certain, but a polynomial within the band has no contact";
            EXPECT_GE(Rational(found->upper), root->lower);
        }
        if (!root)
            continue;
        ++contacts;
        ASSERT_TRUE(found) << "missed a contact within the band";
        EXPECT_LE(Rational(found->lower), root->upper);
    }
    EXPECT_GT(contacts, 300);
    EXPECT_GT(certain, 50);
}

} // namespace
} // namespace chasles::algebra
