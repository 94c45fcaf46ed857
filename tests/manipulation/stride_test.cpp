#include "chasles/manipulation/stride.h"

#include <gtest/gtest.h>

namespace chasles::manipulation {
namespace {

constexpr double margin = 0.01;

Passage passage(double until, std::uint64_t node_pairs) {
    Passage found;
    found.until = until;
    found.work.node_pairs = node_pairs;
    return found;
}

TEST(Stride, IsAnyWayAtFirst) {
    EXPECT_EQ(Stride(margin).share(1e30), 1);
}

TEST(Stride, IsFourTimesTheFreeWayWhereALongSearchWasBlocked) {
    Stride stride(margin);
    stride.learn(8, passage(1.0 / 32, 1000000));
    EXPECT_EQ(stride.share(1), 1);
    EXPECT_EQ(stride.share(2), 0.5);
}

TEST(Stride, IsNeverBelowFourMargins) {
    Stride stride(margin);
    stride.learn(8, passage(0, 1000000));
    EXPECT_EQ(stride.share(4 * margin), 1);
    EXPECT_DOUBLE_EQ(stride.share(8 * margin), 0.5);
}

TEST(Stride, IsNotShortenedByAShortSearchNorWhereMuchOfTheWayWasFree) {
    Stride stride(margin);
    stride.learn(8, passage(1.0 / 32, 100));
    stride.learn(8, passage(0.125, 1000000));
    stride.learn(8, passage(1, 1000000));
    EXPECT_EQ(stride.share(8), 1);
}

TEST(Stride, GrowsWhereStepsGetThroughOrSearchesAreShort) {
    Stride stride(margin);
    stride.learn(32, passage(1.0 / 32, 1000000)); // 4
    stride.learn(2, passage(1, 1000000));         // shorter than it might have been
    EXPECT_EQ(stride.share(8), 0.5);
    stride.learn(8, passage(1, 1000000));
    EXPECT_EQ(stride.share(16), 0.5);
    stride.learn(16, passage(0.01, 100));
    EXPECT_EQ(stride.share(32), 0.5);
}

} // namespace
} // namespace chasles::manipulation
