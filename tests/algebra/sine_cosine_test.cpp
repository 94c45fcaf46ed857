// Sine and cosine in double-double against the functions of Boost in a hundred digits.
#include "chasles/algebra/sine_cosine.h"

#include "tests/support/random.h"

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <gtest/gtest.h>

namespace chasles::test {
namespace {

using algebra::DoubleDouble;
using Digits = boost::multiprecision::cpp_bin_float_100;

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

} // namespace
} // namespace chasles::test
