// Arc tangent and arc sine in double against the functions of Boost in a hundred digits.
#include "chasles/algebra/arc_tangent.h"

#include "tests/support/ulp_error.h"

#include <limits>
#include <numbers>

namespace chasles::test {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double infinity = std::numeric_limits<double>::infinity();

TEST(ArcTangent, OfADirection) {
    Random random(1811);
    UlpError error;
    for (int i = 0; i < angle_rounds(); ++i) {
        const double x = random.scaled(-3, 3);
        const double y = x * random.scaled(-12, 12);
        error.add(algebra::arc_tangent(y, x), atan2(Digits(y), Digits(x)), y / x);
    }
    EXPECT_LE(error.greatest("all directions"), 0.51);
}

/// The tangents at which the table changes, and its own.
TEST(ArcTangent, OfMultiplesOfA32nd) {
    Random random(1812);
    UlpError error;
    for (int i = 0; i < angle_rounds(); ++i) {
        const double tangent = random.integer(-40, 40) / 32.0 + random.scaled(-17, -10);
        error.add(algebra::arc_tangent(tangent), atan(Digits(tangent)), tangent);
    }
    EXPECT_LE(error.greatest("multiples"), 0.51);
}

TEST(ArcTangent, OfTheLargestAndTheSmallestNumbers) {
    Random random(1813);
    UlpError error;
    for (int i = 0; i < angle_rounds(); ++i) {
        const double x = random.scaled(-307, 307);
        const double y = random.chance(0.5) ? random.scaled(-307, 307) : x * random.uniform(-2, 2);
        const Digits truth = atan2(Digits(y), Digits(x));
        if (abs(truth) > std::numeric_limits<double>::min())
            error.add(algebra::arc_tangent(y, x), truth, y / x);
    }
    EXPECT_LE(error.greatest("largest and smallest"), 0.51);
    const double tiny = std::numeric_limits<double>::denorm_min();
    EXPECT_EQ(algebra::arc_tangent(tiny, tiny), pi / 4);
    EXPECT_EQ(algebra::arc_tangent(tiny, 1), tiny);
}

TEST(ArcTangent, OfTheAxes) {
    EXPECT_EQ(algebra::arc_tangent(0, 0), 0);
    EXPECT_EQ(algebra::arc_tangent(0, 1), 0);
    EXPECT_EQ(algebra::arc_tangent(1, 0), pi / 2);
    EXPECT_EQ(algebra::arc_tangent(-1, 0), -pi / 2);
    EXPECT_EQ(algebra::arc_tangent(0, -1), pi);
    EXPECT_EQ(algebra::arc_tangent(-0.0, -1), -pi);
    EXPECT_EQ(algebra::arc_tangent(1, 1), pi / 4);
    EXPECT_TRUE(std::isnan(algebra::arc_tangent(std::nan(""), 1)));
    EXPECT_TRUE(std::isnan(algebra::arc_tangent(1, std::nan(""))));
    EXPECT_TRUE(std::isnan(algebra::arc_tangent(-infinity, infinity)));
    EXPECT_EQ(algebra::arc_tangent(infinity), pi / 2);
    EXPECT_EQ(algebra::arc_tangent(1, infinity), 0);
}

TEST(ArcSine, IsWithinTheBound) {
    Random random(1814);
    UlpError error;
    for (int i = 0; i < angle_rounds(); ++i) {
        const double below_one = 1 - std::abs(random.scaled(-16, 0));
        const double sine =
            random.chance(0.5) ? std::copysign(below_one, random.uniform(-1, 1)) : random.scaled(-12, -0.001);
        error.add(algebra::arc_sine(sine), asin(Digits(sine)), sine);
    }
    EXPECT_LE(error.greatest("arc sine"), 0.51);
    EXPECT_EQ(algebra::arc_sine(1), pi / 2);
    EXPECT_EQ(algebra::arc_sine(-1), -pi / 2);
    EXPECT_EQ(algebra::arc_sine(0), 0);
    EXPECT_TRUE(std::isnan(algebra::arc_sine(1.5)));
}

} // namespace
} // namespace chasles::test
