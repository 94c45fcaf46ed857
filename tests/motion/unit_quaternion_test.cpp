// Quaternions of length one: the bits of the slow algorithm, mostly by the fast one.
#include "chasles/motion/unit_quaternion.h"

#include "chasles/motion/screw_path.h"
#include "tests/support/random_poses.h"

#include <bit>
#include <gtest/gtest.h>

namespace chasles::motion {
namespace {

using namespace test;
using Numbers = Eigen::Vector4d;

FourNumbers lanes(const Numbers& numbers) {
    FourNumbers result;
    for (int i = 0; i < 4; ++i)
        result.set(std::size_t(i), numbers[i]);
    return result;
}

bool is_certain(const Numbers& numbers) {
    return unit_of_near_unit(lanes(numbers)).is_certain;
}

Numbers random_unit(Random& random) {
    return random_pose(random, 1).rotation.coeffs().normalized();
}

void expect_same_bits(const Numbers& numbers) {
    Pose pose(Eigen::Vector3d(1, -2, 3e30 / 7), Eigen::Quaterniond::Identity());
    pose.rotation.coeffs() = numbers;
    const Pose expected = rounded(exact(pose));
    const Pose found = normalized(pose);
    EXPECT_EQ(found.translation, expected.translation);
    for (int i = 0; i < 4; ++i)
        EXPECT_EQ(std::bit_cast<std::uint64_t>(found.rotation.coeffs()[i]),
                  std::bit_cast<std::uint64_t>(expected.rotation.coeffs()[i]))
            << numbers.transpose();
}

TEST(UnitQuaternion, HasTheBitsOfTheLongWay) {
    Random random(7301);
    const int trials = 50'000;
    int sure = 0, changed = 0;
    for (int trial = 0; trial < trials; ++trial) {
        Numbers numbers = random_unit(random);
        for (int i = 0; i < 4; ++i)
            numbers[i] *= 1 + 0x1p-53 * random.integer(-8, 8);
        sure += is_certain(numbers) ? 1 : 0;
        changed += unit_of_near_unit(lanes(numbers)).numbers[0] != numbers[0] ? 1 : 0;
        expect_same_bits(numbers);
    }
    EXPECT_GT(sure, 0.999 * trials);
    EXPECT_GT(changed, 0.2 * trials);
}

TEST(UnitQuaternion, HasTheBitsOfTheLongWayAtAnyLength) {
    Random random(7302);
    int sure = 0, open = 0;
    for (int trial = 0; trial < 20'000; ++trial) {
        const Numbers numbers = random_unit(random) * (1 + std::exp2(random.uniform(-60, 6)));
        (is_certain(numbers) ? sure : open) += 1;
        expect_same_bits(numbers);
    }
    EXPECT_GT(sure, 1000);
    EXPECT_GT(open, 10'000);
}

/// Quaternions of turns about an axis of the frame, exact and rounded.
TEST(UnitQuaternion, HasTheBitsOfTheLongWayNextToAxes) {
    Random random(7303);
    int sure = 0, open = 0;
    for (int trial = 0; trial < 20'000; ++trial) {
        Numbers numbers = random_unit(random);
        for (int i = 0; i < 3; ++i) {
            const double tiny = std::ldexp(random.uniform(-1, 1), random.integer(-1074, -1));
            const double choices[] = {0.0, -0.0, tiny};
            numbers[i] = choices[random.integer(0, 2)];
        }
        numbers[3] = std::sqrt(std::max(0.0, 1 - numbers.head<3>().squaredNorm()));
        (is_certain(numbers) ? sure : open) += 1;
        expect_same_bits(numbers);
    }
    EXPECT_GT(sure, 5000);
    EXPECT_GT(open, 1000);
}

/// A length of exactly one changes nothing. Half a unit in the last place off, only double-doubles decide the rounding.
TEST(UnitQuaternion, IsNotSureInTheMiddleOfTwoDoubles) {
    EXPECT_TRUE(is_certain({0, 0, 0, 1}));
    EXPECT_TRUE(is_certain({0.5, -0.5, 0.5, 0.5}));
    const Numbers middle(0x1p-27, 0x1p-27, 0, 1); // over its length, the last one is 1 - 2^-54 up to 2^-107
    EXPECT_FALSE(is_certain(middle));
    expect_same_bits(middle);
}

TEST(UnitQuaternion, IsNotSureOfWhatIsNoLength) {
    for (const double bad : {0.0, 1e308, std::numeric_limits<double>::infinity(), std::nan("")})
        EXPECT_FALSE(is_certain({bad, 0, 0, bad})) << bad;
}

} // namespace
} // namespace chasles::motion
