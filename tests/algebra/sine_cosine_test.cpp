// Sine, cosine and tangent in double and in double-double against the functions of Boost in a hundred digits.
#include "chasles/algebra/arc_tangent.h"

#include "tests/support/ulp_error.h"

#include <numbers>

namespace chasles::test {
namespace {

using algebra::DoubleDouble;
Digits exactly(const DoubleDouble& number) {
    return Digits(number.high()) + Digits(number.low());
}

DoubleDouble random_angle(Random& random, double size) {
    const double high = random.uniform(-size, size);
    return DoubleDouble::exact_sum(high, high * random.uniform(-0x1p-54, 0x1p-54));
}

double distance(const DoubleDouble& computed, const Digits& truth) {
    return std::abs(double(exactly(computed) - truth));
}

TEST(SineCosine, ErrorsAreWithinTheBound) {
    Random random(1801);
    double greatest = 0;
    for (int i = 0; i < 4000; ++i) {
        const DoubleDouble angle = random_angle(random, std::pow(10, random.uniform(-8, 3)));
        const auto [sine, cosine] = algebra::sine_cosine(angle);
        greatest = std::max({greatest, distance(sine, sin(exactly(angle))), distance(cosine, cos(exactly(angle)))});
    }
    std::cout << "at most 2^" << std::log2(greatest) << "\n";
    EXPECT_LE(greatest, 0x1p-94);
    EXPECT_GT(greatest, 0x1p-110) << "the comparison is not in double-double";
}

/// The angles at which the table and the quarters change.
TEST(SineCosine, MultiplesOfASixteenthOfPi) {
    const Digits pi = boost::math::constants::pi<Digits>();
    for (int i = -70; i <= 70; ++i)
        for (const double beside : {-1e-9, 0.0, 1e-9}) {
            const Digits angle = pi * i / 32 + beside;
            const double high(angle);
            const DoubleDouble rounded = DoubleDouble::exact_sum(high, double(angle - high));
            const auto [sine, cosine] = algebra::sine_cosine(rounded);
            EXPECT_LE(distance(sine, sin(exactly(rounded))), 0x1p-99) << i;
            EXPECT_LE(distance(cosine, cos(exactly(rounded))), 0x1p-99) << i;
        }
}

TEST(SineCosine, TheAngleOfADirection) {
    Random random(1802);
    for (int i = 0; i < 1000; ++i) {
        const DoubleDouble angle = random_angle(random, 3.14159 * std::pow(10, random.uniform(-12, 0)));
        EXPECT_LE(distance(algebra::angle_of(algebra::sine_cosine(angle)), exactly(angle)), 0x1p-98);
    }
    EXPECT_EQ(double(algebra::angle_of(algebra::SineCosine<DoubleDouble>{0.0, 1.0})), 0);
}

/// All sizes, and the angles at which the table, the quarters and the signs change.
TEST(SineCosineInDouble, ErrorsAreWithinTheBound) {
    Random random(1803);
    UlpError sine, cosine, tangent;
    for (int i = 0; i < angle_rounds(); ++i) {
        const double multiple = random.integer(-64, 64) * std::numbers::pi / 32;
        const double angle = random.chance(0.5) ? random.scaled(-20, 5.1175) : multiple + random.scaled(-20, -3);
        const Digits exact(angle);
        sine.add(algebra::sine(angle), sin(exact), angle);
        cosine.add(algebra::cosine(angle), cos(exact), angle);
        tangent.add(algebra::tangent(angle), tan(exact), angle);
    }
    EXPECT_LE(sine.greatest("sine"), 2.0 / 3);
    EXPECT_LE(cosine.greatest("cosine"), 2.0 / 3);
    EXPECT_LE(tangent.greatest("tangent"), 0.8);
}

/// Next to multiples of a quarter turn, whose sine or cosine is tiny: the greatest cancellation.
TEST(SineCosineInDouble, NextToQuarterTurns) {
    UlpError sine, cosine, tangent;
    for (int i = 1; i < 83'000; i += std::getenv("CHASLES_LONG") ? 1 : 17) {
        const double angle(boost::math::constants::half_pi<Digits>() * i);
        sine.add(algebra::sine(angle), sin(Digits(angle)), angle);
        cosine.add(algebra::cosine(angle), cos(Digits(angle)), angle);
        tangent.add(algebra::tangent(angle), tan(Digits(angle)), angle);
    }
    EXPECT_LE(sine.greatest("sine"), 2.0 / 3);
    EXPECT_LE(cosine.greatest("cosine"), 2.0 / 3);
    EXPECT_LE(tangent.greatest("tangent"), 0.8);
}

TEST(SineCosineInDouble, ALargeAngleCountsAsOneNextToIt) {
    Random random(1804);
    for (int i = 0; i < 1000; ++i) {
        const double angle = random.scaled(5.2, 15);
        const double half_ulp = std::ldexp(0.5, std::ilogb(angle) - 52);
        EXPECT_NEAR(algebra::sine(angle), double(sin(Digits(angle))), half_ulp + 0x1p-53) << angle;
        EXPECT_NEAR(algebra::cosine(angle), double(cos(Digits(angle))), half_ulp + 0x1p-53) << angle;
    }
    for (const double angle : {1e300, -1e300})
        EXPECT_NEAR(std::hypot(algebra::sine(angle), algebra::cosine(angle)), 1, 1e-15);
    const double infinity = std::numeric_limits<double>::infinity();
    for (const double angle : {infinity, -infinity, std::nan("")})
        EXPECT_TRUE(std::isnan(algebra::sine(angle)) && std::isnan(algebra::cosine(angle)));
}

} // namespace
} // namespace chasles::test
