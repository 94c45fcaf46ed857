// The rules by which a search weighs brackets, one test a rule.
// Source: docs/derivations/07-swept-boxes.md, "Best", "Second stage" and "Third stage".
#include "chasles/search/search_rules.h"

#include "tests/search/table_stages.h"

#include <gtest/gtest.h>

namespace chasles::search {
namespace {

TEST(SearchState, BestIsTheLeastUpperEndOfWhatIsKept) {
    SearchState state(first_contact_goal);
    EXPECT_EQ(state.best(), 1);
    state.note(proven(0.2, 0.7));
    EXPECT_EQ(state.best(), 0.7);
    state.note(proven(0.1, 0.8));
    EXPECT_EQ(state.best(), 0.7);
    state.note(uncertain(0.3, 0.6));
    EXPECT_EQ(state.best(), 0.6);
}

TEST(SearchState, AnUncertainBracketExtendsTheSearchByTheTolerance) {
    SearchState narrow(first_contact_goal);
    narrow.note(uncertain(0.5, 0.5));
    EXPECT_EQ(narrow.best(), 0.5 + tolerance);
    SearchState is_proven(first_contact_goal);
    is_proven.note(proven(0.5, 0.5));
    EXPECT_EQ(is_proven.best(), 0.5);
    SearchState at_start(first_contact_goal);
    at_start.note(uncertain(0, 0));
    EXPECT_EQ(at_start.best(), 0) << "what touches at the start is not proven by what touches later";
}

TEST(SearchState, ABracketIsFinalIfItIsProvenAndNarrowAndNotAtTheStart) {
    const SearchState state(first_contact_goal);
    EXPECT_TRUE(state.is_final(proven(0.5, 0.5 + 0.5 * tolerance)));
    EXPECT_FALSE(state.is_final(uncertain(0.5, 0.5 + 0.5 * tolerance)));
    EXPECT_FALSE(state.is_final(proven(0.5, 0.5 + 2 * tolerance)));
    EXPECT_FALSE(state.is_final(proven(0, 0)));
    EXPECT_FALSE(state.is_final(proven(0, 0.5 * tolerance)));
}

TEST(SearchState, ABracketAtTheStartIsFinalWhereTheStartIsTestedApart) {
    const SearchState state(start_tested_apart);
    EXPECT_TRUE(state.is_final(proven(0, 0.5 * tolerance)));
    EXPECT_FALSE(state.is_final(proven(0, 2 * tolerance)));
    EXPECT_FALSE(state.is_final(uncertain(0, 0)));
}

TEST(SearchState, ACandidateIsAfterAProvenOneIfItStartsNoEarlierThanAFinalBracket) {
    SearchState state(first_contact_goal);
    state.note(proven(0.4, 0.9));
    EXPECT_FALSE(state.is_after_proven(uncertain(0.5, 0.6))) << "a wide bracket does not count";
    state.note(final_at(0.5));
    EXPECT_TRUE(state.is_after_proven(uncertain(0.5, 0.6)));
    EXPECT_FALSE(state.is_after_proven(uncertain(0.5 - 0.1 * tolerance, 0.6)));
}

TEST(SearchState, ACandidateIsWithinTheToleranceOfTheLeastProvenUpperEnd) {
    SearchState state(first_contact_goal);
    state.note(proven(0.25, 0.5));
    EXPECT_TRUE(state.is_within_tolerance_of_proven(uncertain(0.5 - 0.9 * tolerance, 0.6)));
    EXPECT_FALSE(state.is_within_tolerance_of_proven(uncertain(0.5 - 1.1 * tolerance, 0.6)));
    state.forget_proven();
    EXPECT_FALSE(state.is_within_tolerance_of_proven(uncertain(0.5, 0.6)));
}

TEST(SearchState, ACandidateAtTheStartIsWithinTheToleranceOnlyOfAContactAtTheStart) {
    SearchState soon(first_contact_goal);
    soon.note(proven(0, 0.5 * tolerance));
    EXPECT_FALSE(soon.is_within_tolerance_of_proven(uncertain(0, 0)));
    SearchState at_start(first_contact_goal);
    at_start.note(proven(0, 0));
    EXPECT_TRUE(at_start.is_within_tolerance_of_proven(uncertain(0, 0)));
}

TEST(SearchState, ACandidateIsNearlySimultaneousFromAThirtiethPowerBeforeTheProvenContactOn) {
    SearchState state(first_contact_goal);
    EXPECT_FALSE(state.is_nearly_simultaneous_with_proven(uncertain(0.5, 0.6)));
    state.note(proven(0.25, 0.5));
    EXPECT_TRUE(state.is_nearly_simultaneous_with_proven(uncertain(0.5 - 0.9 * nearly_simultaneous, 0.6)));
    EXPECT_TRUE(state.is_nearly_simultaneous_with_proven(uncertain(0.7, 0.8)));
    EXPECT_FALSE(state.is_nearly_simultaneous_with_proven(uncertain(0.5 - 1.1 * nearly_simultaneous, 0.6)));
}

TEST(SearchState, NothingAtTheStartIsNearlySimultaneous) {
    SearchState state(first_contact_goal);
    state.note(proven(1e-15, 1e-14));
    EXPECT_FALSE(state.is_nearly_simultaneous_with_proven(uncertain(0, 0.1)));
}

TEST(SearchState, AnyContactEndsTheSearchForAny) {
    for (const FeasibleInterval& tau : {proven(0.5, 0.9), uncertain(0.5, 0.9), proven(0, 0)}) {
        SearchState state(any_contact);
        EXPECT_FALSE(state.is_over());
        state.note(tau);
        EXPECT_TRUE(state.is_over());
    }
}

TEST(SearchState, AContactThatMayBeAtTheStartEndsTheSearchForTheFirst) {
    const auto is_over = [](const SearchGoal& goal, const FeasibleInterval& tau) {
        SearchState state(goal);
        state.note(tau);
        return state.is_over();
    };
    const SearchGoal goal = first_contact_goal;
    EXPECT_TRUE(is_over(goal, proven(0, 0)));
    EXPECT_TRUE(is_over(goal, uncertain(0, 0.1)));
    EXPECT_FALSE(is_over(goal, proven(0, 0.1))) << "proven to be after the start";
    EXPECT_FALSE(is_over(goal, proven(0.1, 0.1)));
    const SearchGoal apart = start_tested_apart;
    EXPECT_TRUE(is_over(apart, uncertain(0, 0)));
    EXPECT_FALSE(is_over(apart, uncertain(0, 0.1))) << "what is at the start is tested apart";
}

TEST(SearchState, ShortenAndStopNeedNoCandidate) {
    SearchState state(first_contact_goal);
    state.shorten(0.5);
    EXPECT_EQ(state.best(), 0.5);
    EXPECT_EQ(state.proven_upper(), never);
    EXPECT_FALSE(state.is_over());
    state.stop();
    EXPECT_TRUE(state.is_over());
}

} // namespace
} // namespace chasles::search
