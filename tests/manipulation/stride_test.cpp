#include "chasles/manipulation/stride.h"

#include <gtest/gtest.h>

namespace chasles::manipulation {
namespace {

constexpr double margin = 0x1p-10;
constexpr std::uint64_t brief = 100;
constexpr std::uint64_t lengthy = 1000000;

/// The length of the first part of a long way.
double first_part(const Stride& stride) {
    return 1e6 * stride.first_share(1e6);
}

TEST(Stride, BeginsWithEightMargins) {
    const Stride stride(margin);
    EXPECT_EQ(stride.first_share(8 * margin), 1);
    EXPECT_EQ(stride.first_share(4 * margin), 1);
    EXPECT_EQ(stride.first_share(32 * margin), 0.25);
}

TEST(Stride, PartsGrowUntilTheWayEnds) {
    EXPECT_EQ(Stride::next_share(0.125), 0.5);
    EXPECT_EQ(Stride::next_share(0.5), 1);
}

TEST(Stride, TellsALongSearch) {
    EXPECT_FALSE(Stride::is_long(brief));
    EXPECT_TRUE(Stride::is_long(lengthy));
}

TEST(Stride, AFreeWayIsTheNextFirstPartIfItsSearchWasShort) {
    Stride stride(margin);
    stride.learn(3, false, brief);
    EXPECT_DOUBLE_EQ(first_part(stride), 3);
    stride.learn(1, false, brief);
    EXPECT_DOUBLE_EQ(first_part(stride), 3);
    stride.learn(1, false, lengthy);
    EXPECT_DOUBLE_EQ(first_part(stride), 0.5);
}

TEST(Stride, TwiceTheWayToAnObstacleIsTheNextFirstPart) {
    Stride stride(margin);
    stride.learn(3, false, brief);
    stride.learn(0.25, true, lengthy);
    EXPECT_DOUBLE_EQ(first_part(stride), 0.5);
}

TEST(Stride, IsNeverBelowEightMargins) {
    Stride stride(margin);
    stride.learn(0, true, lengthy);
    EXPECT_EQ(stride.first_share(16 * margin), 0.5);
    stride.learn(margin, false, lengthy);
    EXPECT_EQ(stride.first_share(16 * margin), 0.5);
}

} // namespace
} // namespace chasles::manipulation
