// Double-double arithmetic against exact rationals: the relative error stays below 2^-101.
#include "chasles/algebra/double_double.h"

#include "tests/support/random.h"
#include "tests/support/rational.h"

namespace chasles::algebra {
namespace {

using namespace test;

const Rational bound(0x1p-101);

/// A full double-double, sometimes with a short or an extremely small low part.
DoubleDouble random_number(Random& random, int largest_exponent) {
    const double high = std::ldexp(random.uniform(1, 2), random.integer(-largest_exponent, largest_exponent));
    const double sign = random.chance(0.5) ? 1 : -1;
    if (random.chance(0.1))
        return DoubleDouble(sign * high);
    const int gap = random.chance(0.2) ? random.integer(54, 110) : 54;
    return DoubleDouble(sign * high) + DoubleDouble(std::ldexp(random.uniform(-high, high), -gap));
}

/// A number that agrees with `a` in about `bits` leading bits.
DoubleDouble close_to(const DoubleDouble& a, int bits, Random& random) {
    return a + DoubleDouble(std::ldexp(a.high() * random.uniform(0.5, 1), -bits));
}

void expect_close(const DoubleDouble& computed, const Rational& truth) {
    EXPECT_LE(test::magnitude(test::exact(computed) - truth), bound * test::magnitude(truth));
    EXPECT_LE(std::abs(computed.low()), std::abs(computed.high()) * 0x1p-53) << "not normalised";
}

void expect_arithmetic(const DoubleDouble& a, const DoubleDouble& b) {
    const Rational x = test::exact(a);
    const Rational y = test::exact(b);
    expect_close(a + b, x + y);
    expect_close(a - b, x - y);
    expect_close(a * b, x * y);
    expect_close(a / b, x / y);
}

TEST(DoubleDouble, ArithmeticIsGoodTo101Bits) {
    Random random(201);
    for (int trial = 0; trial < 20000; ++trial) {
        const DoubleDouble a = random_number(random, 20);
        expect_arithmetic(a, random_number(random, 20));
    }
}

TEST(DoubleDouble, ArithmeticIsGoodTo101BitsForExtremeExponents) {
    Random random(202);
    for (int trial = 0; trial < 20000; ++trial) {
        const DoubleDouble a = random_number(random, 380);
        expect_arithmetic(a, random_number(random, 380));
    }
}

TEST(DoubleDouble, CancellationLosesNothing) {
    Random random(203);
    for (int trial = 0; trial < 20000; ++trial) {
        const DoubleDouble a = random_number(random, 20);
        const DoubleDouble b = close_to(a, random.integer(1, 104), random);
        expect_close(a - b, test::exact(a) - test::exact(b));
        expect_close(a + -b, test::exact(a) - test::exact(b));
    }
}

TEST(DoubleDouble, NumberMinusItselfIsZero) {
    Random random(204);
    for (int trial = 0; trial < 1000; ++trial) {
        const DoubleDouble a = random_number(random, 300);
        EXPECT_EQ(a - a, DoubleDouble(0.0));
    }
}

TEST(DoubleDouble, QuotientsNearOneAreGood) {
    Random random(205);
    for (int trial = 0; trial < 10000; ++trial) {
        const DoubleDouble a = random_number(random, 20);
        const DoubleDouble b = close_to(a, random.integer(1, 104), random);
        expect_close(a / b, test::exact(a) / test::exact(b));
    }
}

/// The root x of a is within the bound if ((1 - bound) r)^2 <= a <= ((1 + bound) r)^2 for the computed r.
void expect_root(const DoubleDouble& a) {
    const Rational root = test::exact(sqrt(a));
    const Rational lower = root * (1 - bound);
    const Rational upper = root * (1 + bound);
    EXPECT_LE(lower * lower, test::exact(a));
    EXPECT_GE(upper * upper, test::exact(a));
}

TEST(DoubleDouble, SquareRootsAreGoodTo101Bits) {
    Random random(206);
    for (int trial = 0; trial < 20000; ++trial) {
        const DoubleDouble a = random_number(random, trial % 2 == 0 ? 20 : 600);
        expect_root(a < DoubleDouble(0.0) ? -a : a);
    }
}

TEST(DoubleDouble, SquareRootsOfSquaresAreExact) {
    for (int n = 0; n <= 1000; ++n)
        EXPECT_EQ(sqrt(DoubleDouble(double(n) * n)), DoubleDouble(double(n)));
}

TEST(DoubleDouble, SquareRootOfWhatIsNotPositiveIsZero) {
    EXPECT_EQ(sqrt(DoubleDouble(0.0)), DoubleDouble(0.0));
    EXPECT_EQ(sqrt(DoubleDouble(-1e-40)), DoubleDouble(0.0));
}

TEST(DoubleDouble, SumsAndProductsOfDoublesAreExact) {
    Random random(207);
    for (int trial = 0; trial < 10000; ++trial) {
        const double a = random.scaled(-100, 100);
        const double b = random.scaled(-100, 100);
        EXPECT_EQ(test::exact(DoubleDouble::exact_sum(a, b)), Rational(a) + Rational(b));
        EXPECT_EQ(test::exact(DoubleDouble::exact_product(a, b)), Rational(a) * Rational(b));
    }
}

TEST(DoubleDouble, OrderIsThatOfTheNumbers) {
    Random random(208);
    for (int trial = 0; trial < 10000; ++trial) {
        const DoubleDouble a = random_number(random, 2);
        const DoubleDouble b = random.chance(0.3) ? a : close_to(a, random.integer(50, 104), random);
        EXPECT_EQ(a < b, test::exact(a) < test::exact(b));
        EXPECT_EQ(a > b, test::exact(a) > test::exact(b));
        EXPECT_EQ(a <= b, test::exact(a) <= test::exact(b));
        EXPECT_EQ(a >= b, test::exact(a) >= test::exact(b));
        EXPECT_EQ(a == b, test::exact(a) == test::exact(b));
    }
}

} // namespace
} // namespace chasles::algebra
