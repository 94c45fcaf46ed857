// Signs against exact rationals, for points at which rounding gives wrong signs.
#include "chasles/mesh/exact_orientation.h"

#include "chasles/algebra/exact_sum.h"

#include <gmpxx.h>
#include <gtest/gtest.h>
#include <limits>
#include <random>

namespace chasles {
namespace {

using Eigen::Vector2d;

int exact_sign(const Vector2d& a, const Vector2d& b, const Vector2d& c) {
    const mpq_class left = (mpq_class(a.x()) - c.x()) * (mpq_class(b.y()) - c.y());
    const mpq_class right = (mpq_class(a.y()) - c.y()) * (mpq_class(b.x()) - c.x());
    return cmp(left, right) < 0 ? -1 : cmp(left, right) > 0 ? 1 : 0;
}

int naive_sign(const Vector2d& a, const Vector2d& b, const Vector2d& c) {
    const double value = (a.x() - c.x()) * (b.y() - c.y()) - (a.y() - c.y()) * (b.x() - c.x());
    return value < 0.0 ? -1 : value > 0.0 ? 1 : 0;
}

TEST(ExactSum, HasTheSignOfWhatRoundingWouldLose) {
    ExactSum sum;
    EXPECT_EQ(sum.sign(), 0);
    sum.add_product(1e300, 1e300);
    sum.add_product(5e-324, 5e-324);
    EXPECT_EQ(sum.sign(), 1);
    sum.add_product(-1e300, 1e300);
    EXPECT_EQ(sum.sign(), 1);
    sum.add_product(5e-324, -5e-324);
    EXPECT_EQ(sum.sign(), 0);
    sum.add_product(-5e-324, 5e-324);
    EXPECT_EQ(sum.sign(), -1);
}

TEST(ExactSum, AgreesWithRationalsOverAllExponents) {
    const unsigned seed = 20240501;
    SCOPED_TRACE(seed);
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> mantissa(-1.0, 1.0);
    std::uniform_int_distribution<int> exponent(-1073, 1023);
    for (int round = 0; round < 2000; ++round) {
        ExactSum sum;
        mpq_class exact = 0;
        for (int term = 0; term < 3; ++term) {
            const double a = std::ldexp(mantissa(random), exponent(random));
            const double b = std::ldexp(mantissa(random), exponent(random));
            sum.add_product(a, b);
            sum.add_product(-a, b / 2);
            exact += mpq_class(a) * b - mpq_class(a) * (b / 2);
        }
        ASSERT_EQ(sum.sign(), sgn(exact)) << "round " << round;
    }
}

TEST(Orientation, AgreesWithRationalsNearLines) {
    const unsigned seed = 20240502;
    SCOPED_TRACE(seed);
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    int collinear = 0;
    int naive_is_wrong = 0;
    for (int round = 0; round < 20000; ++round) {
        const Vector2d a(unit(random), unit(random));
        const Vector2d step =
            std::ldexp(1.0, -53) * Vector2d(std::floor(8 * unit(random)), std::floor(8 * unit(random)));
        const Vector2d b = round % 2 == 0 ? Vector2d(a + step) : Vector2d(a / 2);
        const Vector2d c = round % 4 < 2 ? Vector2d(a / 4 + step) : Vector2d(2 * a);
        const int expected = exact_sign(a, b, c);
        ASSERT_EQ(orientation(a, b, c), expected) << "round " << round;
        ASSERT_EQ(orientation(b, a, c), -expected) << "round " << round;
        collinear += expected == 0 ? 1 : 0;
        naive_is_wrong += naive_sign(a, b, c) != expected ? 1 : 0;
    }
    // The test would show nothing if rounded signs were right too.
    EXPECT_GT(collinear, 1000);
    EXPECT_GT(naive_is_wrong, 100);
}

TEST(Orientation, HoldsWhereProductsUnderflowOrAreHuge) {
    const double tiny = 1e-200;
    EXPECT_EQ(orientation({0, 0}, {tiny, 0}, {0, tiny}), 1);
    EXPECT_EQ(orientation({0, 0}, {tiny, tiny}, {2 * tiny, 2 * tiny}), 0);
    EXPECT_EQ(orientation({0, 0}, {1e30, 1e30}, {1, std::nextafter(1.0, 2.0)}), 1);
    EXPECT_EQ(orientation({0, 0}, {3e30, 1e30}, {3, 1}), exact_sign({0, 0}, {3e30, 1e30}, {3, 1}));
}

TEST(Collinear, IsExactInSpace) {
    const Eigen::Vector3d a(0.1, 0.2, 0.3);
    EXPECT_TRUE(are_collinear(a, 2 * a, 4 * a));
    EXPECT_FALSE(are_collinear(a, 2 * a, 4 * a + Eigen::Vector3d(0, 0, 1e-15)));
    EXPECT_TRUE(are_collinear(a, a, {5, 6, 7}));
    // The projections along two of the three axes have no area.
    EXPECT_FALSE(are_collinear({0, 0, 0}, {1, 0, 0}, {0, 1, 0}));
    EXPECT_FALSE(are_collinear({0, 0, 0}, {0, 1, 0}, {0, 0, 1}));
    EXPECT_FALSE(are_collinear({0, 0, 0}, {1, 0, 0}, {0, 0, 1}));
}

TEST(LiesBeyond, ComparesAlongTheLine) {
    EXPECT_FALSE(lies_beyond({0, 0}, {1, 1}, {2, 2}));
    EXPECT_FALSE(lies_beyond({0, 0}, {0, 0}, {2, 2}));
    EXPECT_TRUE(lies_beyond({0, 0}, {3, 3}, {2, 2}));
    EXPECT_TRUE(lies_beyond({0, 0}, {0, -1}, {0, 2}));
}

} // namespace
} // namespace chasles
