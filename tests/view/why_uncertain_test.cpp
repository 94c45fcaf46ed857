// Why an answer is not certain: times are shares of the motion.
#include "view/why_uncertain.h"

#include <gtest/gtest.h>

namespace chasles {
namespace {

const std::string apart = "; they are 2e-13 apart where the bracket begins, in double precision";
const std::string at_the_end =
    "the bodies just reach each other at the end of the motion, and a rounding error decides whether they meet" + apart;

FirstContact contact_at(const Bracket& time, double speed) {
    FirstContact found;
    found.verdict = Verdict::contact;
    found.time = time;
    found.contacts.emplace_back();
    found.contacts.back().approach_speed = speed;
    found.contacts.back().gap = -2e-13;
    return found;
}

TEST(WhyUncertain, NamesTheEndOfTheMotionOnlyThere) {
    const std::string by_rounding = "a rounding error decides whether the features named here meet" + apart;
    EXPECT_EQ(view::why_uncertain(contact_at({0.5, 0.5}, 1)), by_rounding);
    EXPECT_EQ(view::why_uncertain(contact_at({1 - 1e-15, 1}, 1)), at_the_end);
    EXPECT_EQ(view::why_uncertain(contact_at({1 - 1e-15, 1}, 1), false), by_rounding) << "another motion follows";
}

TEST(WhyUncertain, NamesWidthsAndSlides) {
    EXPECT_EQ(view::why_uncertain(contact_at({0.5, 0.6}, 1)),
              "the bounds of the motion do not tell contact from a miss of the bodies within this bracket" + apart);
    EXPECT_EQ(
        view::why_uncertain(contact_at({0.5, 0.5}, 0)),
        "the features named here slide along or graze each other, and a rounding error decides whether they meet" +
            apart);
}

TEST(WhyUncertain, NamesTheLeastOfTheGaps) {
    FirstContact found = contact_at({0.5, 0.5}, 1);
    found.contacts.insert(found.contacts.begin(), Contact());
    found.contacts.front().gap = 3e-5;
    EXPECT_TRUE(view::why_uncertain(found).ends_with(apart));
    found.contacts.clear();
    EXPECT_EQ(view::why_uncertain(found), "a rounding error decides whether the features named here meet");
}

} // namespace
} // namespace chasles
