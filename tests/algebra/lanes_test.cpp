// The vector register and the plain array give the same four numbers.
#include "chasles/algebra/lanes.h"

#include "chasles/algebra/double_double.h"
#include "tests/support/random.h"
#include "tests/support/rational.h"

#include <limits>

namespace chasles::algebra {
namespace {

using test::Random;
using test::Rational;
using Register = Lanes<4, double>;
using Plain = Lanes<4, Rational>;

double random_lane(Random& random) {
    return random.chance(0.2) ? 0.0 : double(random.integer(-8, 8));
}

Register random_register(Random& random) {
    Register lanes;
    for (std::size_t i = 0; i < 4; ++i)
        lanes.set(i, random_lane(random));
    return lanes;
}

Plain plain(const Register& lanes) {
    Plain result;
    for (std::size_t i = 0; i < 4; ++i)
        result.set(i, Rational(lanes[i]));
    return result;
}

void expect_same(const Register& lanes, const Plain& reference) {
    for (std::size_t i = 0; i < 4; ++i)
        EXPECT_EQ(Rational(lanes[i]), reference[i]) << "lane " << i;
}

TEST(Lanes, RegisterDoesWhatThePlainArrayDoes) {
    Random random(301);
    int above = 0;
    for (int trial = 0; trial < 5000; ++trial) {
        const Register a = random_register(random);
        const Register b = random_register(random);
        expect_same(a + b, plain(a) + plain(b));
        expect_same(a - b, plain(a) - plain(b));
        expect_same(a * b, plain(a) * plain(b));
        expect_same(maximum(a, b), maximum(plain(a), plain(b)));
        expect_same(magnitude(a), magnitude(plain(a)));
        EXPECT_EQ(all_above(a, b), all_above(plain(a), plain(b)));
        above += all_above(a, b) ? 1 : 0;
    }
    EXPECT_GT(above, 100);
}

DoubleDouble random_double_double(Random& random) {
    const double high = random_lane(random);
    return random.chance(0.5) ? DoubleDouble(high) : DoubleDouble::exact_sum(high, random.uniform(-0x1p-54, 0x1p-54));
}

/// Compares all bits, including the low words.
void expect_same(const Lanes<4, DoubleDouble>& lanes, const std::array<DoubleDouble, 4>& expected) {
    for (std::size_t i = 0; i < 4; ++i)
        EXPECT_EQ(lanes[i], expected[i]) << "lane " << i;
}

TEST(Lanes, RegistersOfDoubleDoublesDoWhatOneDoes) {
    Random random(302);
    using Four = Lanes<4, DoubleDouble>;
    const auto each = [](const Four& a, const Four& b, auto operation) {
        return std::array{operation(a[0], b[0]), operation(a[1], b[1]), operation(a[2], b[2]), operation(a[3], b[3])};
    };
    int above = 0;
    for (int trial = 0; trial < 5000; ++trial) {
        Four a, b;
        for (std::size_t i = 0; i < 4; ++i) {
            a.set(i, random_double_double(random));
            b.set(i, random.chance(0.2) ? a[i] : random_double_double(random));
        }
        expect_same(a + b, each(a, b, [](auto x, auto y) { return x + y; }));
        expect_same(a - b, each(a, b, [](auto x, auto y) { return x - y; }));
        expect_same(a * b, each(a, b, [](auto x, auto y) { return x * y; }));
        expect_same(maximum(a, b), each(a, b, [](auto x, auto y) { return x < y ? y : x; }));
        expect_same(magnitude(a), each(a, b, [](auto x, auto) { return x < DoubleDouble(0) ? -x : x; }));
        expect_same(Four::broadcast(a[0]), {a[0], a[0], a[0], a[0]});
        const auto is_above = each(a, b, [](auto x, auto y) { return x > y; });
        EXPECT_EQ(all_above(a, b), is_above[0] && is_above[1] && is_above[2] && is_above[3]);
        above += all_above(a, b) ? 1 : 0;
    }
    EXPECT_GT(above, 100);
}

TEST(Lanes, AllAboveNeedsEveryLane) {
    for (std::size_t lane = 0; lane < 4; ++lane) {
        Register a = Register::broadcast(1);
        EXPECT_TRUE(all_above(a, Register::broadcast(0)));
        a.set(lane, 0);
        EXPECT_FALSE(all_above(a, Register::broadcast(0))) << "lane " << lane << " is equal, not above";
        a.set(lane, std::numeric_limits<double>::quiet_NaN());
        EXPECT_FALSE(all_above(a, Register::broadcast(0))) << "lane " << lane << " is not a number";
    }
}

TEST(Lanes, AllFillsEveryLane) {
    expect_same(Register::broadcast(7), Plain::broadcast(7));
    EXPECT_EQ((Lanes<7, Rational>::broadcast(Rational(3))[6]), 3);
}

TEST(Lanes, StartAtZero) {
    expect_same(Register(), Plain::broadcast(0));
    EXPECT_EQ((Lanes<3, Rational>()[2]), 0);
}

} // namespace
} // namespace chasles::algebra
