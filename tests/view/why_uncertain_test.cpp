// Why an answer is not certain: times are shares of the motion.
#include "view/why_uncertain.h"

#include <gtest/gtest.h>

namespace chasles {
namespace {

const std::string at_the_end =
    "the bodies just reach each other at the end of the motion, and may miss by a rounding error";

FirstContact contact_at(const Bracket& time, double speed) {
    FirstContact found;
    found.verdict = Verdict::contact;
    found.time = time;
    found.contacts.emplace_back();
    found.contacts.back().approach_speed = speed;
    return found;
}

TEST(WhyUncertain, NamesTheEndOfTheMotionOnlyThere) {
    const std::string by_rounding = "the bodies may miss each other by a rounding error";
    EXPECT_EQ(view::why_uncertain(contact_at({0.5, 0.5}, 1)), by_rounding);
    EXPECT_EQ(view::why_uncertain(contact_at({1 - 1e-15, 1}, 1)), at_the_end);
    EXPECT_EQ(view::why_uncertain(contact_at({1 - 1e-15, 1}, 1), false), by_rounding) << "another motion follows";
}

TEST(WhyUncertain, NamesWidthsAndSlides) {
    EXPECT_EQ(view::why_uncertain(contact_at({0.5, 0.6}, 1)),
              "the bounds of the motion do not tell contact from a miss within this bracket");
    EXPECT_EQ(view::why_uncertain(contact_at({0.5, 0.5}, 0)),
              "the bodies slide along or graze each other there, and may miss each other by a rounding error");
}

} // namespace
} // namespace chasles
