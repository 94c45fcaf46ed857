#include "chasles/algebra/exact_roots.h"

#include "tests/support/exact_feasible.h"
#include "tests/support/exact_numbers.h"
#include "tests/support/random_problems.h"

namespace chasles::algebra {
namespace {

using namespace test;

template <int Degree>
Bernstein<Degree, ExactNumber> whole(const PowerPolynomial& p) {
    return whole_multiple(test::bernstein_form<Degree>(p));
}

TEST(ExactPowerForm, ThereAndBackIsAPositiveMultiple) {
    const auto p = whole<4>({3, -2, 0, ratio(1, 2)});
    const auto back = algebra::bernstein_form<4>(power_form(p));
    for (int i = 0; i <= 4; ++i)
        EXPECT_EQ(back[i] * p[0], p[i] * back[0]);
    EXPECT_EQ(power_form(p).size(), 4u) << "the leading zero is gone";
}

TEST(ExactPowerForm, CommonDivisorsAreWhatWasMultipliedIn) {
    Random random(721);
    int shared = 0;
    for (int trial = 0; trial < 200; ++trial) {
        const PowerPolynomial common = from_roots({random_root(random), random_root(random)}, 1);
        const PowerPolynomial a = multiplied(common, {random.integer(-5, 5), 1});
        const PowerPolynomial b = multiplied(common, {random.integer(-5, 5), 1});
        const PowerForm found = common_divisor(power_form(whole<3>(a)), power_form(whole<3>(b)));
        EXPECT_EQ(found.size(), test::common_divisor(a, b).size());
        shared += found.size() == 3 ? 1 : 0;
    }
    EXPECT_GT(shared, 100);
}

TEST(ExactRoots, AgreeWithSturm) {
    Random random(722);
    int several = 0, multiple = 0, points = 0;
    for (int trial = 0; trial < 600; ++trial) {
        const PowerPolynomial p = random_function(random, 5);
        if (p.empty())
            continue;
        auto found = ExactRoot<5>::roots_of(whole<5>(p));
        auto truth = roots_in_unit_interval(p);
        ASSERT_EQ(found.size(), truth.size());
        for (std::size_t i = 0; i < found.size(); ++i) {
            found[i].narrow_to(90);
            truth[i].narrow_to(Rational(0x1p-90));
            EXPECT_LE(test::exact(found[i].lower()), truth[i].upper);
            EXPECT_GE(test::exact(found[i].upper()), truth[i].lower);
            EXPECT_EQ(found[i].sign_of(whole<5>(p)), 0);
            points += found[i].is_point() ? 1 : 0;
        }
        several += found.size() > 1 ? 1 : 0;
        multiple += degree(test::square_free(p)) < degree(p) ? 1 : 0;
    }
    EXPECT_GT(several, 200);
    EXPECT_GT(multiple, 150);
    EXPECT_GT(points, 200);
}

TEST(ExactRoots, SignsOfOtherPolynomialsAgreeWithSturm) {
    Random random(723);
    int signs[3] = {0, 0, 0};
    for (int trial = 0; trial < 400; ++trial) {
        const PowerPolynomial p = random_function(random, 3);
        const PowerPolynomial q = random_function(random, 3);
        if (p.empty())
            continue;
        auto found = ExactRoot<3>::roots_of(whole<3>(p));
        const auto truth = roots_in_unit_interval(p);
        for (std::size_t i = 0; i < found.size(); ++i) {
            const int sign = found[i].sign_of(whole<3>(q));
            EXPECT_EQ(sign, sign_at(q, truth[i]));
            ++signs[sign + 1];
        }
    }
    for (const int count : signs)
        EXPECT_GT(count, 60);
}

/// tau^2 - 1/2 and (tau^2 - 1/2) (tau + 1) + 2^-400: one root is shared, the other is missed by a tiny amount.
TEST(ExactRoots, TellARootFromItsNeighbour) {
    auto root = ExactRoot<3>::roots_of(whole<3>({ratio(-1, 2), 0, 1}));
    ASSERT_EQ(root.size(), 1u);
    const PowerPolynomial same = multiplied({ratio(-1, 2), 0, 1}, {1, 1});
    EXPECT_EQ(root[0].sign_of(whole<3>(same)), 0);
    EXPECT_EQ(root[0].sign_of(whole<3>(sum(same, {power_of_two(-400)}))), 1);
    EXPECT_EQ(root[0].sign_of(whole<3>(sum(same, {Rational(-power_of_two(-400))}))), -1);
}

TEST(ExactRoots, OfPolynomialsWithARootInTheirCoefficients) {
    const Dyadic two(2);
    const ExactNumber root_of_two = ExactNumber::root_of(two);
    Bernstein<1, ExactNumber> p; // 2 tau = root of 2
    p.set(0, -root_of_two);
    p.set(1, ExactNumber(2) - root_of_two);
    auto roots = ExactRoot<1>::roots_of(p);
    ASSERT_EQ(roots.size(), 1u);
    roots[0].narrow_to(60);
    EXPECT_NEAR(roots[0].lower().rounded_down(), std::sqrt(0.5), 1e-15);
    Bernstein<1, ExactNumber> twin; // the same root, scaled by 1 + root of 2
    for (int i = 0; i < 2; ++i)
        twin.set(i, p[i] * (ExactNumber(1) + root_of_two));
    EXPECT_EQ(roots[0].sign_of(twin), 0);
}

} // namespace
} // namespace chasles::algebra
