#include "chasles/algebra/exact_number.h"

#include "tests/support/exact_numbers.h"
#include "tests/support/random.h"

namespace chasles::algebra {
namespace {

using test::Random;
using test::Rational;

/// p / q runs through the best approximations of the square root of 2, alternately below and above the root.
TEST(ExactNumber, SignsOfTheBestApproximationsOfARoot) {
    const Dyadic two(2);
    const ExactNumber root = ExactNumber::root_of(two);
    ExactNumber p(1), q(1);
    for (int step = 0; step < 400; ++step) {
        const int side = step % 2 == 0 ? -1 : 1;
        EXPECT_EQ((p - q * root).sign(), side) << step;
        EXPECT_EQ((q * root - p).sign(), -side) << step;
        const ExactNumber next = p + q + q;
        q = p + q;
        p = next;
    }
}

TEST(ExactNumber, ARootTimesItselfIsTheRadicand) {
    const Dyadic radicand(0.1);
    const ExactNumber root = ExactNumber::root_of(radicand);
    EXPECT_EQ(root * root, ExactNumber(0.1));
    EXPECT_EQ((root - root).sign(), 0);
    EXPECT_EQ((root + ExactNumber(1)) * (root - ExactNumber(1)), ExactNumber(0.1) - ExactNumber(1));
}

TEST(ExactNumber, ARootThatIsRationalIsThatNumber) {
    const Dyadic radicand(2.25);
    EXPECT_EQ(ExactNumber::root_of(radicand), ExactNumber(1.5));
    const Dyadic nothing;
    EXPECT_EQ(ExactNumber::root_of(nothing).sign(), 0);
}

/// The root of 49/16 is 7/4, so every number is also a rational.
TEST(ExactNumber, ArithmeticAgreesWithRationals) {
    Random random(711);
    const Dyadic radicand(49.0 / 16);
    const ExactNumber root = ExactNumber::root_of(radicand);
    int zeros = 0;
    for (int trial = 0; trial < 300; ++trial) {
        ExactNumber x;
        Rational truth(0);
        for (int step = 0; step < 10; ++step) {
            const double a = random.integer(-7, 7);
            const double b = random.chance(0.3) ? 0 : random.integer(-4, 4);
            const ExactNumber y = ExactNumber(a) + ExactNumber(b) * root;
            const Rational y_truth = Rational(a) + Rational(b) * Rational(1.75);
            const int operation = random.integer(0, 2);
            x = operation == 0 ? x + y : operation == 1 ? x - y : x * y;
            truth = operation == 0 ? truth + y_truth : operation == 1 ? truth - y_truth : truth * y_truth;
            ASSERT_EQ(x.sign(), truth.sign());
            ASSERT_EQ(x < y, truth < y_truth);
            zeros += truth == 0 ? 1 : 0;
        }
    }
    EXPECT_GT(zeros, 30);
}

} // namespace
} // namespace chasles::algebra
