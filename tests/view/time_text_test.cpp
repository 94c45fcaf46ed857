// Times as people read them: short ones as ever, stamps with what comes after their point.
#include "view/time_text.h"

#include <gtest/gtest.h>

namespace chasles::view {
namespace {

TEST(TimeText, KeepsWhatIsAfterThePointOfLargeTimes) {
    EXPECT_EQ(time_text(0), "0");
    EXPECT_EQ(time_text(1.0 / 3), "0.333333333333");
    EXPECT_EQ(time_text(1.647101501711296), "1.64710150171");
    EXPECT_EQ(time_text(25.123456789012), "25.123456789");
    EXPECT_EQ(time_text(12345.123456789), "12345.123456789");
    EXPECT_EQ(time_text(1700000000.018), "1700000000.018");
    EXPECT_EQ(time_text(-1700000000.018), "-1700000000.018");
    EXPECT_EQ(time_text(1e300), "1e+300");
}

} // namespace
} // namespace chasles::view
