// The rules by which a search keeps, postpones, decides and drops candidates, one test a rule. The stages that decide
// answer from a table. Source: docs/derivations/07-swept-boxes.md, "Best", "Second stage" and "Third stage".
#include "chasles/search/candidates.h"

#include "tests/search/table_stages.h"

#include <gtest/gtest.h>

namespace chasles::search {
namespace {

// --- "Best" ---

TEST(Candidates, ThatStartAfterBestAreDropped) {
    Search search;
    search.add(1, proven(0.2, 0.5));
    search.add(2, proven(0.6, 0.7));
    search.add(3, uncertain(0.6, 0.7));
    EXPECT_EQ(search.stages.calls, Calls());
    search.finish();
    EXPECT_EQ(search.ids(), Ids{1});
}

TEST(Candidates, ThatStartAtBestAreKept) {
    Search search;
    search.stages.narrowed[1] = proven(0.5, 0.5);
    search.add(1, proven(0.2, 0.5));
    search.add(2, proven(0.5, 0.5));
    search.finish();
    EXPECT_EQ(search.ids(), (Ids{1, 2}));
}

TEST(Candidates, AreDroppedOnceTheSearchIsOver) {
    Search search(any_contact);
    search.add(1, proven(0.5, 0.9));
    search.add(2, proven(0.1, 0.1));
    search.add(3, uncertain(0.1, 0.1));
    EXPECT_EQ(search.stages.calls, Calls());
    EXPECT_EQ(search.candidates.best(), 0.9);
    search.finish();
    EXPECT_EQ(search.ids(), Ids{1}) << "the bracket belongs to the pair that was found";
}

TEST(Candidates, AtTheStartEndTheSearchForTheFirst) {
    Search search;
    search.add(1, uncertain(0, 0));
    search.add(2, uncertain(0, 0));
    EXPECT_EQ(search.stages.calls, Calls{"decide 1"});
    search.finish();
    EXPECT_EQ(search.ids(), Ids{1});
}

TEST(Candidates, ThatStartAfterTheFinalBestAreNotInTheAnswer) {
    Search search;
    search.add(1, proven(0.4, 0.4));
    search.candidates.keep(candidate(2, proven(0.3, 0.3)));
    search.candidates.keep(candidate(3, uncertain(0.2, 0.35)));
    search.finish();
    EXPECT_EQ(search.ids(), (Ids{2, 3}));
}

TEST(Candidates, AnOverlapAtTheStartEndsTheSearch) {
    Search search;
    search.candidates.end_at_start();
    EXPECT_TRUE(search.candidates.state().is_over());
    search.add(1, uncertain(0, 0));
    EXPECT_EQ(search.stages.calls, Calls());
    search.finish();
    EXPECT_EQ(search.ids(), Ids());
}

// --- "Second stage" and "Third stage", during the search ---

TEST(Candidates, ThatTheFilterProvesAreKeptWithoutADecision) {
    Search search;
    search.add(1, proven(0.2, 0.7));
    EXPECT_EQ(search.stages.calls, Calls());
    EXPECT_EQ(search.candidates.best(), 0.7);
}

TEST(Candidates, ThatTheFilterDoesNotProveAreDecided) {
    Search search;
    search.stages.decided[1] = proven(0.3, 0.31);
    search.stages.decided[2] = std::nullopt;
    search.add(1, uncertain(0.2, 0.7));
    search.add(2, uncertain(0.1, 0.2));
    search.add(3, proven(0, 0.1)); // a contact at 0 and one just after it have different verdicts
    EXPECT_EQ(search.stages.calls, (Calls{"decide 1", "decide 2", "decide 3"}));
    EXPECT_EQ(search.candidates.best(), 0.1);
}

TEST(Candidates, TheDecisionReplacesTheBracketOfTheFilter) {
    Search search;
    search.stages.decided[1] = final_at(0.3);
    search.add(1, uncertain(0.2, 0.7));
    search.finish();
    expect_same(search.tau_of(1), final_at(0.3));
}

TEST(Candidates, ThatAreSettledAreNotDecidedAgain) {
    Search search;
    search.stages.settled = {1};
    search.add(1, uncertain(0.2, 0.7));
    EXPECT_EQ(search.stages.calls, Calls());
    search.finish();
    EXPECT_EQ(search.ids(), Ids());
}

TEST(Candidates, NearlySimultaneousOnesArePostponed) {
    Search search;
    search.add(1, proven(0.25, 0.5));
    search.add(2, uncertain(0.5 - 0.5 * nearly_simultaneous, 0.6));
    search.add(3, uncertain(0.5, 0.6));
    EXPECT_EQ(search.stages.calls, Calls());
    search.add(4, uncertain(0.5 - 2 * nearly_simultaneous, 0.6));
    EXPECT_EQ(search.stages.calls, Calls{"decide 4"});
}

TEST(Candidates, NearlySimultaneousOnesThatAreProvenAreKept) {
    Search search;
    search.add(1, final_at(0.5));
    search.add(2, final_at(0.5 - tolerance));
    EXPECT_EQ(search.candidates.best(), final_at(0.5 - tolerance).upper);
}

TEST(Candidates, AfterAProvenOneAtTheStartAreDroppedWhereTheStartIsTestedApart) {
    Search search(start_tested_apart);
    search.candidates.keep(candidate(1, proven(0, 0.5 * tolerance)));
    search.add(2, uncertain(0, 0.1));
    EXPECT_EQ(search.stages.calls, Calls());
}

// --- many features that touch at once ---

TEST(Candidates, SimultaneousOnesAreCountedProvenOrNot) {
    Search search;
    search.add(1, final_at(0.5));
    EXPECT_EQ(search.candidates.simultaneous(), 0U);
    search.add(2, final_at(0.5));
    search.add(3, uncertain(0.5, 0.6));
    search.add(4, uncertain(0.4, 0.6));
    EXPECT_EQ(search.candidates.simultaneous(), 2U);
}

TEST(Candidates, EarlyEnoughIsJustBeforeAFinalContact) {
    Search search;
    search.add(1, final_at(0.5));
    const std::optional<double> early = search.candidates.early_enough(search.stages);
    ASSERT_TRUE(early);
    EXPECT_LT(*early, 0.5);
    EXPECT_LE(final_at(0.5).upper - *early, tolerance) << "a bracket from there on is narrow enough";
    EXPECT_EQ(search.stages.calls, Calls());
}

TEST(Candidates, EarlyEnoughNarrowsTheFirstProvenContact) {
    Search search;
    search.add(1, proven(0.2, 0.9));
    search.add(2, proven(0.3, 0.8));
    search.stages.narrowed[2] = final_at(0.4);
    const std::optional<double> early = search.candidates.early_enough(search.stages);
    EXPECT_EQ(search.stages.calls, Calls{"narrow 2"});
    ASSERT_TRUE(early);
    EXPECT_NEAR(*early, 0.4, tolerance);
    EXPECT_EQ(search.candidates.best(), final_at(0.4).upper);
    EXPECT_EQ(search.candidates.early_enough(search.stages), early);
    EXPECT_EQ(search.stages.calls.size(), 1U) << "once is enough";
}

TEST(Candidates, EarlyEnoughIsNowhereWithoutANarrowProvenContactAfterTheStart) {
    Search nothing;
    EXPECT_FALSE(nothing.candidates.early_enough(nothing.stages));
    Search in_doubt;
    in_doubt.add(1, uncertain(0.5, 0.5));
    EXPECT_FALSE(in_doubt.candidates.early_enough(in_doubt.stages));
    Search wide;
    wide.add(1, proven(0.5, 0.9));
    EXPECT_FALSE(wide.candidates.early_enough(wide.stages)) << "it cannot be narrowed";
    Search at_start;
    at_start.add(1, proven(0, 0));
    EXPECT_FALSE(at_start.candidates.early_enough(at_start.stages));
    Search too_soon;
    too_soon.add(1, proven(0.1 * tolerance, 0.2 * tolerance));
    EXPECT_FALSE(too_soon.candidates.early_enough(too_soon.stages));
}

TEST(Candidates, StopSearchAtDropsLaterOnesAndKeepsTheProvenOne) {
    Search search;
    search.add(1, uncertain(0.4, 0.7));
    search.add(2, uncertain(0.6, 0.65));
    search.add(3, final_at(0.5));
    search.add(4, uncertain(0.5, 0.51)); // postponed
    const std::size_t decisions = search.stages.calls.size();
    const std::optional<double> early = search.candidates.early_enough(search.stages);
    ASSERT_TRUE(early);
    search.candidates.stop_search_at(*early);
    EXPECT_EQ(search.candidates.best(), *early);
    EXPECT_EQ(search.candidates.searched_until(), *early);
    search.add(5, proven(0.5, 0.5));
    search.finish();
    EXPECT_EQ(search.ids(), (Ids{1, 3})) << "the contact that ends the bracket begins later than the search ended";
    EXPECT_EQ(search.stages.calls.size(), decisions);
}

TEST(Candidates, StopSearchAtNeverMovesLater) {
    Search search;
    search.add(1, final_at(0.5));
    search.candidates.stop_search_at(0.3);
    search.candidates.stop_search_at(0.4);
    EXPECT_EQ(search.candidates.searched_until(), 0.3);
}

} // namespace
} // namespace chasles::search
