// Numbers are whole words, correctly rounded, and independent of the locale. Lines and words lose no characters.
#include "chasles/io/text_scan.h"

#include <bit>
#include <clocale>
#include <cmath>
#include <cstring>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <limits>
#include <random>

namespace chasles::io {
namespace {

TEST(ParseNumber, ReadsBackEveryDoubleToTheSameBits) {
    std::mt19937_64 random(20240607);
    for (int i = 0; i < 20000; ++i) {
        const double number = std::bit_cast<double>(random());
        if (!std::isfinite(number))
            continue;
        const auto shortest = parse_number(fmt::format("{}", number));
        const auto long_form = parse_number(fmt::format("{:.25e}", number));
        ASSERT_TRUE(shortest && long_form) << number;
        ASSERT_EQ(std::bit_cast<std::uint64_t>(*shortest), std::bit_cast<std::uint64_t>(number));
        ASSERT_EQ(std::bit_cast<std::uint64_t>(*long_form), std::bit_cast<std::uint64_t>(number));
    }
}

TEST(ParseNumber, RoundsHalfwayCasesToEven) {
    EXPECT_EQ(parse_number("9007199254740993"), 9007199254740992.0); // 2^53 + 1
    EXPECT_EQ(parse_number("9007199254740993.0000000000000000000000000001"), 9007199254740994.0);
    EXPECT_EQ(parse_number("1.00000000000000011102230246251565404236316680908203125"), 1.0);
}

TEST(ParseNumber, KnowsBothEndsOfTheRange) {
    EXPECT_EQ(parse_number("4.9e-324"), std::numeric_limits<double>::denorm_min());
    EXPECT_EQ(parse_number("1e-400"), 0.0);
    EXPECT_TRUE(std::signbit(*parse_number("-1e-400")));
    EXPECT_EQ(parse_number("1e-99999"), 0.0);
    EXPECT_EQ(parse_number("0." + std::string(400, '0') + "1"), 0.0);
    EXPECT_EQ(parse_number("-1" + std::string(400, '0')), -HUGE_VAL);
    EXPECT_EQ(parse_number("1e-99999999999999999999"), 0.0);
    EXPECT_EQ(parse_number("1e99999999999999999999"), HUGE_VAL);
    EXPECT_EQ(parse_number("0e99999"), 0.0);
    EXPECT_TRUE(std::isinf(*parse_number("1e400")));
    EXPECT_TRUE(std::isinf(*parse_number("-1e99999")));
    EXPECT_FALSE(parse_finite("1e400"));
    EXPECT_FALSE(parse_finite("nan"));
}

TEST(ParseNumber, TakesWholeWordsOnly) {
    for (const char* const word : {"1", "+1", "-.5", "1.", "1e3", "1E+3", "-0"})
        EXPECT_TRUE(parse_number(word)) << word;
    for (const char* const word : {"", "+", "-", "1x", "0x10", "1e", "1,5", "+-1", "++1", "1 ", "e5", "."})
        EXPECT_FALSE(parse_number(word)) << word;
}

TEST(ParseNumber, DoesNotFollowTheLocale) {
    const char* const german = std::setlocale(LC_ALL, "de_DE.UTF-8");
    EXPECT_EQ(parse_number("1.5"), 1.5);
    EXPECT_FALSE(parse_number("1,5"));
    std::setlocale(LC_ALL, "C");
    if (german == nullptr)
        GTEST_SKIP() << "the locale de_DE.UTF-8 is not installed";
}

TEST(ParseInteger, TakesWholeNumbersThatFit) {
    EXPECT_EQ(parse_integer("-12"), -12);
    EXPECT_EQ(parse_integer("+12"), 12);
    EXPECT_EQ(parse_integer("9223372036854775807"), std::numeric_limits<std::int64_t>::max());
    for (const char* const word : {"", "1.0", "1e3", "9223372036854775808", "12a"})
        EXPECT_FALSE(parse_integer(word)) << word;
}

TEST(Lines, TakeBothLineEndsAndCountFromOne) {
    Lines lines("one\r\n\ntwo");
    ASSERT_TRUE(lines.next());
    EXPECT_EQ(lines.line(), "one");
    ASSERT_TRUE(lines.next());
    EXPECT_EQ(lines.line(), "");
    ASSERT_TRUE(lines.next());
    EXPECT_EQ(lines.line(), "two");
    EXPECT_EQ(lines.number(), 3U);
    EXPECT_FALSE(lines.next());
}

TEST(Lines, EndWithCarriageReturnsToo) {
    Lines lines("a\rb\r\rc\r\n\nd\r");
    for (const char* const line : {"a", "b", "", "c", "", "d"}) {
        ASSERT_TRUE(lines.next());
        EXPECT_EQ(lines.line(), line);
    }
    EXPECT_EQ(lines.position(), 12U);
    EXPECT_FALSE(lines.next());
}

TEST(Lines, TakeTimeInProportionToTheText) {
    for (const std::string_view end : {"\r", "\n", "\r\n"}) {
        std::string text;
        for (int i = 0; i < 1'000'000; ++i)
            text += end;
        Lines lines(text); // a search to the end of the text for each line would take minutes
        while (lines.next()) {
        }
        EXPECT_EQ(lines.number(), 1'000'000U);
    }
}

TEST(Words, AreSeparatedByAnyBlanks) {
    Words words(" a\tb  c ");
    EXPECT_EQ(words.next(), "a");
    EXPECT_EQ(words.next(), "b");
    EXPECT_EQ(words.next(), "c");
    EXPECT_EQ(words.next(), "");
}

TEST(ValidUtf8, ReplacesWhatIsNoCharacter) {
    for (const std::string_view good :
         {"a", "\xc3\xa9", "\xe2\x82\xac", "\xf0\x9f\x94\xa9", "\xed\x9f\xbf", "\xf4\x8f\xbf\xbf"})
        EXPECT_EQ(valid_utf8(good), good);
    // Latin-1, a byte that follows nothing, a cut character, an overlong slash, a surrogate, beyond Unicode.
    EXPECT_EQ(valid_utf8("caf\xe9s"), "caf?s");
    EXPECT_EQ(valid_utf8("\x80"), "?");
    EXPECT_EQ(valid_utf8("a\xe2\x82"), "a??");
    EXPECT_EQ(valid_utf8("\xc0\xaf"), "??");
    EXPECT_EQ(valid_utf8("\xed\xa0\x80"), "???");
    EXPECT_EQ(valid_utf8("\xf4\x90\x80\x80"), "????");
}

TEST(DifferByASlip, IsOneLetterOrTwoNeighbours) {
    for (const auto& [a, b] : std::vector<std::pair<std::string, std::string>>{{"collision", "colision"},
                                                                               {"collision", "collisions"},
                                                                               {"collision", "collisiom"},
                                                                               {"collision", "ollision"},
                                                                               {"collision", "colliison"},
                                                                               {"ab", "ba"},
                                                                               {"a", ""}}) {
        EXPECT_TRUE(differ_by_a_slip(a, b)) << a << ' ' << b;
        EXPECT_TRUE(differ_by_a_slip(b, a)) << b << ' ' << a;
    }
    for (const auto& [a, b] : std::vector<std::pair<std::string, std::string>>{{"collision", "collision"},
                                                                               {"", ""},
                                                                               {"collision", "colision s"},
                                                                               {"collision", "coliison"},
                                                                               {"abc", "cba"},
                                                                               {"ab", ""}}) {
        EXPECT_FALSE(differ_by_a_slip(a, b)) << a << ' ' << b;
        EXPECT_FALSE(differ_by_a_slip(b, a)) << b << ' ' << a;
    }
}

// What would move the cursor, start an escape sequence, or show the rest of a line from right to left.
TEST(OneLine, HasNoCharacterThatActsOnATerminal) {
    EXPECT_EQ(one_line("a\tb\r\nc"), "a b  c");
    EXPECT_EQ(one_line(std::string("\x1b[31m\0\x7f", 7)), "?[31m??");
    EXPECT_EQ(one_line("\u009b31m \u0085 \u2028 \u2029"), "?31m ? ? ?");
    EXPECT_EQ(one_line("\u202ecod.exe \u2066x\u2069 \u200f\u061c"), "?cod.exe ?x? ??");
    for (const std::string seen :
         {"Zahnrad \u00e4\u00df", "\u6b6f\u8eca", "\u05d2\u05dc\u05d2\u05dc", "\U0001f6e0 \u2013 \u00a0", "\xff\xfe"})
        EXPECT_EQ(one_line(seen), seen);
}

TEST(InQuotes, IsShortPrintableAndOneLine) {
    EXPECT_EQ(in_quotes("  v 1 2\t3 \n"), "'v 1 2 3'");
    EXPECT_EQ(in_quotes(std::string("a\0\xff\x1b", 4)), "'a"
                                                        "???"
                                                        "'");
    EXPECT_EQ(in_quotes(std::string(100, 'x')), "'" + std::string(60, 'x') + "...'");
}

} // namespace
} // namespace chasles::io
