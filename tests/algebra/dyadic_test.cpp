#include "chasles/algebra/dyadic.h"

#include "tests/support/exact_numbers.h"
#include "tests/support/random.h"

#include <limits>

namespace chasles::algebra {
namespace {

using test::Random;
using test::Rational;

TEST(Dyadic, TakesEveryDoubleAsItIs) {
    using limits = std::numeric_limits<double>;
    for (const double x : {0.0, -0.0, 1.0, -3.0, 0.1, 1e300, limits::max(), limits::min(), limits::denorm_min(),
                           -limits::denorm_min() * 12345, 0x1.fffffffffffffp-1}) {
        EXPECT_EQ(test::exact(Dyadic(x)), Rational(x)) << x;
        EXPECT_EQ(Dyadic(x).sign(), x < 0 ? -1 : x > 0 ? 1 : 0);
    }
}

TEST(Dyadic, ArithmeticAgreesWithRationals) {
    Random random(701);
    for (int trial = 0; trial < 300; ++trial) {
        Dyadic x(random.scaled(-9, 9));
        Rational truth = test::exact(x);
        for (int step = 0; step < 8; ++step) {
            const double other = random.chance(0.2) ? 0 : random.scaled(-9, 9);
            switch (random.integer(0, 3)) {
            case 0:
                x = x + other;
                truth += other;
                break;
            case 1:
                x = x - other;
                truth -= other;
                break;
            case 2:
                x = x * Dyadic(other);
                truth *= other;
                break;
            default:
                x = x.times_power_of_two(-3);
                truth /= 8;
                break;
            }
            ASSERT_EQ(test::exact(x), truth);
            ASSERT_EQ(x.sign(), truth.sign());
            ASSERT_EQ(x < Dyadic(other), truth < Rational(other));
        }
    }
}

TEST(Dyadic, RoundsToTheDoublesAround) {
    Random random(702);
    int exact = 0;
    for (int trial = 0; trial < 1000; ++trial) {
        const double near = random.chance(0.3) ? random.scaled(-320, -300) : random.scaled(-20, 0);
        const double offset = random.chance(0.2) ? 0 : std::ldexp(random.scaled(-1, 1), std::ilogb(near) - 60);
        const Dyadic x = Dyadic(near) + Dyadic(offset);
        const Dyadic fine = x + (random.chance(0.5) ? Dyadic() : Dyadic(1).times_power_of_two(-1200));
        const double down = fine.rounded_down();
        const double up = fine.rounded_up();
        EXPECT_FALSE(fine < Dyadic(down));
        EXPECT_FALSE(Dyadic(up) < fine);
        exact += down == up ? 1 : 0;
        if (down != up) {
            EXPECT_EQ(up, std::nextafter(down, 2.0));
        }
    }
    EXPECT_GT(exact, 30);
    EXPECT_LT(exact, 500);
}

} // namespace
} // namespace chasles::algebra
