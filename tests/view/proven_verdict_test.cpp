// Answers about the least distance and the verdicts that they prove.
#include "view/proven_verdict.h"

#include <gtest/gtest.h>

namespace chasles {
namespace {

Verdict verdict_of(const Bracket& distance, const Bracket& time) {
    LeastDistance found;
    found.distance = distance;
    found.time = time;
    return view::proven_verdict(found);
}

TEST(ProvenVerdict, IsClearOnlyWithADistanceAboveZero) {
    EXPECT_EQ(verdict_of({1e-300, 1}, {0, 0}), Verdict::clear);
    EXPECT_EQ(verdict_of({0, 1e-300}, {0, 0}), Verdict::unknown);
    EXPECT_EQ(verdict_of({0, 1}, {0.5, 0.5}), Verdict::unknown);
}

TEST(ProvenVerdict, IsContactOnlyWithTheDistanceZero) {
    EXPECT_EQ(verdict_of({0, 0}, {0.5, 0.5}), Verdict::contact);
    EXPECT_EQ(verdict_of({0, 0}, {0, 1e-300}), Verdict::contact);
    EXPECT_EQ(verdict_of({0, 0}, {0, 0}), Verdict::contact_at_start);
}

} // namespace
} // namespace chasles
