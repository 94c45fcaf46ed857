// The rules for candidates after the last interval, one test a rule: which brackets are narrowed, decided or dropped.
// Source: docs/derivations/07-swept-boxes.md, "Second stage" and "Third stage".
#include "chasles/search/candidates.h"

#include "tests/search/table_stages.h"

#include <gtest/gtest.h>

namespace chasles::search {
namespace {

// --- after the search ---

TEST(Candidates, SettleNarrowsWideBrackets) {
    Search search;
    search.stages.narrowed[1] = final_at(0.3);
    search.add(1, proven(0.2, 0.7));
    search.finish();
    EXPECT_EQ(search.stages.calls, Calls{"narrow 1"});
    expect_same(search.tau_of(1), final_at(0.3));
}

TEST(Candidates, SettleComparesNoWideBracketWithItself) {
    Search search;
    search.add(1, proven(0.2, 0.7));
    search.finish();
    EXPECT_EQ(search.stages.proven_upper, std::vector<double>{never});
}

TEST(Candidates, SettleTakesFinalBracketsFirst) {
    Search search;
    search.add(1, proven(0.2, 0.7));
    search.add(2, final_at(0.5));
    search.finish();
    EXPECT_EQ(search.stages.calls, Calls{"narrow 1"});
    EXPECT_EQ(search.stages.proven_upper, std::vector<double>{final_at(0.5).upper});
}

TEST(Candidates, SettleNarrowsWideBracketsInTheOrderOfTheirUpperEnds) {
    Search search;
    search.add(1, proven(0.3, 0.9));
    search.add(2, proven(0.1, 0.8));
    search.add(3, proven(0.2, 0.7));
    search.finish();
    EXPECT_EQ(search.stages.calls, (Calls{"narrow 3", "narrow 2", "narrow 1"}));
}

TEST(Candidates, SettleDropsWideBracketsThatStartAfterANarrowedOne) {
    Search search;
    search.stages.narrowed[3] = final_at(0.25);
    search.add(1, proven(0.3, 0.9));
    search.add(2, proven(0.1, 0.8));
    search.add(3, proven(0.2, 0.7));
    search.finish();
    EXPECT_EQ(search.stages.calls, (Calls{"narrow 3", "narrow 2"}));
    EXPECT_EQ(search.ids(), (Ids{2, 3}));
}

TEST(Candidates, SettleDropsAWideBracketThatNarrowRefutes) {
    Search search;
    search.stages.narrowed[1] = std::nullopt;
    search.add(1, proven(0.2, 0.7));
    search.finish();
    EXPECT_EQ(search.ids(), Ids());
}

TEST(Candidates, SettleNarrowsNothingAtTheStart) {
    Search search;
    search.candidates.keep(candidate(1, proven(0, 0)));
    search.finish();
    EXPECT_EQ(search.stages.calls, Calls());
    EXPECT_EQ(search.ids(), Ids{1});
}

TEST(Candidates, SettleKeepsUncertainBracketsAsTheyAre) {
    Search search;
    search.add(1, uncertain(0.2, 0.7));
    search.add(2, final_at(0.5));
    const std::size_t decisions = search.stages.calls.size();
    search.finish();
    EXPECT_EQ(search.stages.calls.size(), decisions);
    expect_same(search.tau_of(1), uncertain(0.2, 0.7));
}

TEST(Candidates, AnUncertainBracketEndsWhereAProvenContactFollowsWithinTheTolerance) {
    const double before = 0.5 - 0.5 * tolerance;
    Search search;
    search.add(1, uncertain(before, before));
    search.add(2, final_at(0.5));
    search.finish();
    EXPECT_EQ(search.ids(), (Ids{1, 2}));
    expect_same(search.tau_of(1), uncertain(before, 1));
}

TEST(Candidates, AnUncertainBracketAtTheStartStaysThere) {
    Search search;
    search.candidates.keep(candidate(1, uncertain(0, 0)));
    search.candidates.keep(candidate(2, proven(0, 0)));
    search.finish();
    expect_same(search.tau_of(1), uncertain(0, 0));
}

TEST(Candidates, PostponedOnesAfterAProvenOneAreDroppedWithoutADecision) {
    Search search;
    search.add(1, final_at(0.5));
    search.add(2, uncertain(0.5, 0.6));
    search.add(3, uncertain(0.5 + 0.1 * tolerance, 0.6));
    search.finish();
    EXPECT_EQ(search.stages.calls, Calls());
    EXPECT_EQ(search.ids(), Ids{1});
}

TEST(Candidates, PostponedOnesThatStartAfterBestAreDropped) {
    Search search;
    search.stages.narrowed[1] = final_at(0.3);
    search.add(1, proven(0.25, 0.5));
    search.add(2, uncertain(0.5, 0.6));
    search.finish();
    EXPECT_EQ(search.stages.calls, Calls{"narrow 1"});
    EXPECT_EQ(search.ids(), Ids{1});
}

TEST(Candidates, PostponedOnesWithinTheToleranceOfAProvenOneStayInDoubt) {
    const double before = 0.5 - 0.5 * tolerance;
    Search search;
    search.add(1, final_at(0.5));
    search.add(2, uncertain(before, 0.6));
    search.finish();
    EXPECT_EQ(search.stages.calls, Calls());
    EXPECT_EQ(search.ids(), (Ids{1, 2}));
    expect_same(search.tau_of(2), uncertain(before, 1));
}

TEST(Candidates, OtherPostponedOnesAreDecided) {
    const double before = 0.5 - 10 * tolerance;
    Search search;
    search.stages.decided[2] = final_at(before);
    search.stages.decided[3] = std::nullopt;
    search.add(1, final_at(0.5));
    search.add(2, uncertain(before, 0.6));
    search.add(3, uncertain(before - tolerance, 0.6));
    search.add(4, uncertain(before - 2 * tolerance, 0.6));
    search.finish();
    EXPECT_EQ(search.stages.calls, (Calls{"decide 2", "decide 3", "decide 4"}));
    EXPECT_EQ(search.ids(), (Ids{2, 4})) << "2 is the first proven contact, 4 may be one before it";
    expect_same(search.tau_of(2), final_at(before));
}

TEST(Candidates, APostponedOneThatIsDecidedInDoubtEndsWhereAProvenContactFollows) {
    const double before = 0.5 - 10 * tolerance;
    const double after_decision = 0.5 - 0.5 * tolerance;
    Search search;
    search.stages.decided[2] = uncertain(after_decision, after_decision);
    search.add(1, final_at(0.5));
    search.add(2, uncertain(before, 0.6));
    search.finish();
    EXPECT_EQ(search.stages.calls, Calls{"decide 2"});
    expect_same(search.tau_of(2), uncertain(after_decision, 1));
}

} // namespace
} // namespace chasles::search
