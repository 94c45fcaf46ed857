// Numbers in messages, against std::to_chars.
#include "chasles/base/number_text.h"

#include "tests/support/random.h"

#include <bit>
#include <charconv>
#include <limits>

namespace chasles::test {
namespace {

template <class... Format>
std::string by_to_chars(double number, Format... format) {
    std::array<char, 400> text{};
    return {text.data(), std::to_chars(text.data(), text.data() + text.size(), number, format...).ptr};
}

/// Any bits, and numbers of everyday sizes. Whole numbers of more than 17 digits have zeros where to_chars has all
/// digits.
std::vector<double> numbers() {
    Random random(2001);
    std::vector<double> all{0.0, -0.0, 1,    10,      1e4,  1e5,    123456,
                            0.1, 1e-4, 1e-5, 1.0 / 3, 1e22, 5e-324, 1.7976931348623157e308};
    for (int i = 0; i < 20'000; ++i) {
        all.push_back(std::ldexp(random.scaled(0, 0.3), random.integer(-1070, 1020)));
        all.push_back(random.scaled(-6, 15));
        all.push_back(std::round(random.scaled(0, 7)) / 1000);
    }
    std::erase_if(all, [](double x) { return std::abs(x) > 1e16 && std::abs(x) < 1e25; });
    return all;
}

TEST(NumberText, IsTheShortestThatReadsBack) {
    for (const double x : numbers())
        EXPECT_EQ(number_text(x), by_to_chars(x));
}

TEST(NumberText, OfAFewDigitsIsThatOfPrintf) {
    for (const double x : numbers())
        for (const int digits : {1, 3, 6, 17})
            EXPECT_EQ(number_text(x, digits), by_to_chars(x, std::chars_format::general, digits));
}

/// A power of two may have one digit more than needed: the numbers below it are nearer than those above it.
TEST(NumberText, ReadsBackForWholeNumbersOfManyDigitsAndPowersOfTwo) {
    std::vector<double> all{123456789012345683968.0, -9007199254740993000.0, 1e17};
    for (int i = -1074; i < 1024; ++i)
        all.push_back(std::ldexp(1.0, i));
    for (const double x : all) {
        const std::string text = number_text(x);
        double read = 0;
        std::from_chars(text.data(), text.data() + text.size(), read);
        EXPECT_EQ(read, x) << text;
    }
}

TEST(NumberText, OfTimesKeepsWhatIsAfterThePointOfLargeOnes) {
    EXPECT_EQ(time_text(0), "0");
    EXPECT_EQ(time_text(1.0 / 3), "0.333333333333");
    EXPECT_EQ(time_text(1.647101501711296), "1.64710150171");
    EXPECT_EQ(time_text(25.123456789012), "25.123456789");
    EXPECT_EQ(time_text(12345.123456789), "12345.123456789");
    EXPECT_EQ(time_text(1700000000.018), "1700000000.018");
    EXPECT_EQ(time_text(-1700000000.018), "-1700000000.018");
    EXPECT_EQ(time_text(1e300), "1e+300");
    EXPECT_EQ(time_text(std::numeric_limits<double>::infinity()), "inf");
}

TEST(NumberText, OfNumbersThatAreNotFinite) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    EXPECT_EQ(number_text(infinity), "inf");
    EXPECT_EQ(number_text(-infinity, 3), "-inf");
    EXPECT_EQ(number_text(std::nan("")), "nan");
}

} // namespace
} // namespace chasles::test
