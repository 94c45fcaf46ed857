// The rules by which a search keeps, postpones, decides and drops candidates, one test a rule. The stages that decide
// answer from a table. Source: docs/derivations/07-swept-boxes.md, "Best", "Second stage" and "Third stage".
#include "chasles/search/candidates.h"

#include <gtest/gtest.h>
#include <map>
#include <set>
#include <string>

namespace chasles::search {
namespace {

constexpr double tolerance = 1e-12;
constexpr double never = 2; ///< SearchState::proven_upper() where nothing is proven

FeasibleInterval proven(double lower, double upper) {
    return {lower, upper, true};
}
FeasibleInterval uncertain(double lower, double upper) {
    return {lower, upper, false};
}
/// A proven contact with a final bracket.
FeasibleInterval final_at(double lower) {
    return proven(lower, lower + 0.25 * tolerance);
}

/// The candidate number `id`.
Candidate candidate(std::uint32_t id, const FeasibleInterval& tau) {
    return {{ContactKind::vertex_face, {id, id}, {0, 0}}, tau};
}

/// Stages that record what they are asked and answer from tables. A candidate that a table does not name is decided,
/// or narrowed, to the bracket that it has.
class TableStages {
public:
    using Answer = std::optional<FeasibleInterval>;

    std::map<std::uint32_t, Answer> decided;
    std::map<std::uint32_t, Answer> narrowed;
    std::set<std::uint32_t> settled;
    std::vector<std::string> calls;
    std::vector<double> proven_upper; ///< of the state, at each call

    [[nodiscard]] bool is_proven(const Candidate& c) const { return c.tau.certain && c.tau.lower > 0; }
    [[nodiscard]] bool is_settled(const Candidate& c) const { return settled.contains(c.moving.first); }
    Answer decide(const Candidate& c, const SearchState& state) { return answer("decide ", decided, c, state); }
    Answer narrow(const Candidate& c, const SearchState& state) { return answer("narrow ", narrowed, c, state); }

private:
    Answer answer(const std::string& call, const std::map<std::uint32_t, Answer>& table, const Candidate& c,
                  const SearchState& state) {
        calls.push_back(call + std::to_string(c.moving.first));
        proven_upper.push_back(state.proven_upper());
        const auto found = table.find(c.moving.first);
        return found == table.end() ? Answer(c.tau) : found->second;
    }
};
static_assert(LaterStages<TableStages>);

using Calls = std::vector<std::string>;
using Ids = std::vector<std::uint32_t>;

/// One search, its stages, and what it answers.
struct Search {
    explicit Search(const SearchGoal& goal = {.tolerance = tolerance}) : candidates(goal) {}

    TableStages stages;
    Candidates candidates;
    std::vector<Candidate> answer; ///< after finish()

    void add(std::uint32_t id, const FeasibleInterval& tau) { candidates.add(candidate(id, tau), stages); }
    void finish() {
        candidates.settle(stages);
        answer = candidates.take();
    }
    /// The candidates of the answer, in order of their numbers.
    [[nodiscard]] Ids ids() const {
        Ids result;
        for (const Candidate& c : answer)
            result.push_back(c.moving.first);
        std::ranges::sort(result);
        return result;
    }
    [[nodiscard]] FeasibleInterval tau_of(std::uint32_t id) const {
        for (const Candidate& c : answer)
            if (c.moving.first == id)
                return c.tau;
        ADD_FAILURE() << "candidate " << id << " is not in the answer";
        return {};
    }
};

SearchGoal goal_of(Find find, bool start_is_tested_apart = false) {
    return {.find = find, .tolerance = tolerance, .start_is_tested_apart = start_is_tested_apart};
}
/// `hold` lists the contacts of the first moment, whatever is searched for.
SearchGoal holding() {
    SearchGoal goal = goal_of(Find::first, true);
    goal.lists_contacts = true;
    return goal;
}
constexpr Find list_all = Find::first_with_all_contacts;

void expect_same(const FeasibleInterval& found, const FeasibleInterval& expected) {
    EXPECT_EQ(found.lower, expected.lower);
    EXPECT_EQ(found.upper, expected.upper);
    EXPECT_EQ(found.certain, expected.certain);
}

// --- the state of a search ---

TEST(SearchState, BestIsTheLeastUpperEndOfWhatIsKept) {
    SearchState state(goal_of(Find::first));
    EXPECT_EQ(state.best(), 1);
    state.note(proven(0.2, 0.7));
    EXPECT_EQ(state.best(), 0.7);
    state.note(proven(0.1, 0.8));
    EXPECT_EQ(state.best(), 0.7);
    state.note(uncertain(0.3, 0.6));
    EXPECT_EQ(state.best(), 0.6);
}

TEST(SearchState, AnUncertainBracketExtendsTheSearchByTheTolerance) {
    SearchState narrow(goal_of(Find::first));
    narrow.note(uncertain(0.5, 0.5));
    EXPECT_EQ(narrow.best(), 0.5 + tolerance);
    SearchState is_proven(goal_of(Find::first));
    is_proven.note(proven(0.5, 0.5));
    EXPECT_EQ(is_proven.best(), 0.5);
    SearchState at_start(goal_of(list_all));
    at_start.note(uncertain(0, 0));
    EXPECT_EQ(at_start.best(), 0) << "what touches at the start is not proven by what touches later";
}

TEST(SearchState, ABracketIsFinalIfItIsProvenAndNarrowAndNotAtTheStart) {
    const SearchState state(goal_of(Find::first));
    EXPECT_TRUE(state.is_final(proven(0.5, 0.5 + 0.5 * tolerance)));
    EXPECT_FALSE(state.is_final(uncertain(0.5, 0.5 + 0.5 * tolerance)));
    EXPECT_FALSE(state.is_final(proven(0.5, 0.5 + 2 * tolerance)));
    EXPECT_FALSE(state.is_final(proven(0, 0)));
    EXPECT_FALSE(state.is_final(proven(0, 0.5 * tolerance)));
}

TEST(SearchState, ABracketAtTheStartIsFinalWhereTheStartIsTestedApart) {
    const SearchState state(goal_of(Find::first, true));
    EXPECT_TRUE(state.is_final(proven(0, 0.5 * tolerance)));
    EXPECT_FALSE(state.is_final(proven(0, 2 * tolerance)));
    EXPECT_FALSE(state.is_final(uncertain(0, 0)));
}

TEST(SearchState, ACandidateIsAfterAProvenOneIfItStartsNoEarlierThanAFinalBracket) {
    SearchState state(goal_of(Find::first));
    state.note(proven(0.4, 0.9));
    EXPECT_FALSE(state.is_after_proven(uncertain(0.5, 0.6))) << "a wide bracket does not count";
    state.note(final_at(0.5));
    EXPECT_TRUE(state.is_after_proven(uncertain(0.5, 0.6)));
    EXPECT_FALSE(state.is_after_proven(uncertain(0.5 - 0.1 * tolerance, 0.6)));
}

TEST(SearchState, NothingIsAfterAProvenOneWhereContactsAreListed) {
    for (const SearchGoal& goal : {goal_of(list_all), holding()}) {
        SearchState state(goal);
        state.note(final_at(0.5));
        EXPECT_FALSE(state.is_after_proven(uncertain(0.5, 0.6)));
    }
}

TEST(SearchState, ACandidateIsWithinTheToleranceOfTheLeastProvenUpperEnd) {
    SearchState state(goal_of(Find::first));
    state.note(proven(0.25, 0.5));
    EXPECT_TRUE(state.is_within_tolerance_of_proven(uncertain(0.5 - 0.9 * tolerance, 0.6)));
    EXPECT_FALSE(state.is_within_tolerance_of_proven(uncertain(0.5 - 1.1 * tolerance, 0.6)));
    state.forget_proven();
    EXPECT_FALSE(state.is_within_tolerance_of_proven(uncertain(0.5, 0.6)));
}

TEST(SearchState, ACandidateAtTheStartIsWithinTheToleranceOnlyOfAContactAtTheStart) {
    SearchState soon(goal_of(list_all));
    soon.note(proven(0, 0.5 * tolerance));
    EXPECT_FALSE(soon.is_within_tolerance_of_proven(uncertain(0, 0)));
    SearchState at_start(goal_of(list_all));
    at_start.note(proven(0, 0));
    EXPECT_TRUE(at_start.is_within_tolerance_of_proven(uncertain(0, 0)));
}

TEST(SearchState, ACandidateIsNearlySimultaneousFromAThirtiethPowerBeforeTheProvenContactOn) {
    SearchState state(goal_of(Find::first));
    EXPECT_FALSE(state.is_nearly_simultaneous_with_proven(uncertain(0.5, 0.6)));
    state.note(proven(0.25, 0.5));
    EXPECT_TRUE(state.is_nearly_simultaneous_with_proven(uncertain(0.5 - 0.9 * nearly_simultaneous, 0.6)));
    EXPECT_TRUE(state.is_nearly_simultaneous_with_proven(uncertain(0.7, 0.8)));
    EXPECT_FALSE(state.is_nearly_simultaneous_with_proven(uncertain(0.5 - 1.1 * nearly_simultaneous, 0.6)));
}

TEST(SearchState, NothingAtTheStartIsNearlySimultaneous) {
    SearchState state(goal_of(Find::first));
    state.note(proven(1e-15, 1e-14));
    EXPECT_FALSE(state.is_nearly_simultaneous_with_proven(uncertain(0, 0.1)));
}

TEST(SearchState, NothingIsNearlySimultaneousWhereAllContactsAreListed) {
    SearchState state(goal_of(list_all));
    state.note(final_at(0.5));
    EXPECT_FALSE(state.is_nearly_simultaneous_with_proven(uncertain(0.5, 0.6)));
}

TEST(SearchState, FindAnyIsOverAtTheFirstCandidate) {
    for (const FeasibleInterval& tau : {proven(0.5, 0.9), uncertain(0.5, 0.9), proven(0, 0)}) {
        SearchState state(goal_of(Find::any));
        EXPECT_FALSE(state.is_over());
        state.note(tau);
        EXPECT_TRUE(state.is_over());
    }
}

TEST(SearchState, FindFirstIsOverAtAContactThatMayBeAtTheStart) {
    const auto is_over = [](const SearchGoal& goal, const FeasibleInterval& tau) {
        SearchState state(goal);
        state.note(tau);
        return state.is_over();
    };
    const SearchGoal goal = goal_of(Find::first);
    EXPECT_TRUE(is_over(goal, proven(0, 0)));
    EXPECT_TRUE(is_over(goal, uncertain(0, 0.1)));
    EXPECT_FALSE(is_over(goal, proven(0, 0.1))) << "proven to be after the start";
    EXPECT_FALSE(is_over(goal, proven(0.1, 0.1)));
    const SearchGoal apart = goal_of(Find::first, true);
    EXPECT_TRUE(is_over(apart, uncertain(0, 0)));
    EXPECT_FALSE(is_over(apart, uncertain(0, 0.1))) << "what is at the start is tested apart";
    EXPECT_FALSE(is_over(goal_of(list_all), proven(0, 0)));
}

TEST(SearchState, ShortenAndStopNeedNoCandidate) {
    SearchState state(goal_of(Find::first));
    state.shorten(0.5);
    EXPECT_EQ(state.best(), 0.5);
    EXPECT_EQ(state.proven_upper(), never);
    EXPECT_FALSE(state.is_over());
    state.stop();
    EXPECT_TRUE(state.is_over());
}

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
    Search search(goal_of(Find::any));
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

TEST(Candidates, AtTheStartAreAllListedIfAllAreAskedFor) {
    Search search(goal_of(list_all));
    search.add(1, uncertain(0, 0));
    search.add(2, uncertain(0, 0));
    search.add(3, proven(0.1, 0.1));
    search.finish();
    EXPECT_EQ(search.ids(), (Ids{1, 2}));
}

TEST(Candidates, ThatStartAfterTheFinalBestAreNotInTheAnswer) {
    Search search;
    search.add(1, proven(0.4, 0.4));
    search.candidates.keep(candidate(2, proven(0.3, 0.3)));
    search.candidates.keep(candidate(3, uncertain(0.2, 0.35)));
    search.finish();
    EXPECT_EQ(search.ids(), (Ids{2, 3}));
}

TEST(Candidates, AnOverlapAtTheStartLeavesOnlyWhatMayBeAtTheStart) {
    Search search(goal_of(list_all));
    search.add(1, uncertain(0, 0));
    search.add(2, proven(0.5, 0.5));
    search.candidates.end_at_start(false);
    EXPECT_FALSE(search.candidates.state().is_over());
    EXPECT_EQ(search.candidates.best(), 0);
    search.add(3, proven(0.1, 0.1));
    search.add(4, uncertain(0, 0));
    search.finish();
    EXPECT_EQ(search.ids(), (Ids{1, 4}));
}

TEST(Candidates, AnOverlapAtTheStartEndsTheSearchIfAsked) {
    Search search;
    search.candidates.end_at_start(true);
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

TEST(Candidates, NearlySimultaneousOnesAreDecidedAtOnceWhereAllAreListed) {
    Search search(goal_of(list_all));
    search.add(1, proven(0.25, 0.5));
    search.add(2, uncertain(0.5, 0.6));
    EXPECT_EQ(search.stages.calls, Calls{"decide 2"});
}

TEST(Candidates, AfterAProvenOneAtTheStartAreDroppedWhereTheStartIsTestedApart) {
    Search search(goal_of(Find::first, true));
    search.candidates.keep(candidate(1, proven(0, 0.5 * tolerance)));
    search.add(2, uncertain(0, 0.1));
    EXPECT_EQ(search.stages.calls, Calls());
    Search list(holding());
    list.candidates.keep(candidate(1, proven(0, 0.5 * tolerance)));
    list.add(2, uncertain(0, 0.1));
    EXPECT_EQ(list.stages.calls, Calls{"decide 2"});
}

TEST(Candidates, WithinTheBracketAreAllListedIfAllAreAskedFor) {
    Search search(goal_of(list_all));
    search.stages.decided[3] = final_at(0.5 + 0.1 * tolerance);
    search.stages.decided[4] = std::nullopt;
    search.add(1, final_at(0.5));
    search.add(2, final_at(0.5 + 0.1 * tolerance));
    search.add(3, uncertain(0.5 + 0.1 * tolerance, 0.6));
    search.add(4, uncertain(0.5 + 0.1 * tolerance, 0.6));
    search.add(5, uncertain(0.5 + 0.1 * tolerance, 0.6));
    search.add(6, final_at(0.5 + tolerance));
    search.finish();
    EXPECT_EQ(search.ids(), (Ids{1, 2, 3, 5}));
    EXPECT_EQ(search.stages.calls, (Calls{"decide 3", "decide 4", "decide 5"}));
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

TEST(Candidates, SimultaneousOnesAreNotCountedWhereAllAreListed) {
    Search search(goal_of(list_all));
    for (std::uint32_t i = 0; i < 5; ++i)
        search.add(i, final_at(0.5));
    EXPECT_EQ(search.candidates.simultaneous(), 0U);
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
    Search at_start(goal_of(list_all));
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
    Search search(goal_of(list_all));
    search.add(1, uncertain(0, 0));
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

TEST(Candidates, PostponedOnesAtTheContactAreListedForBodiesThatHoldContacts) {
    Search search(holding());
    search.add(1, final_at(0.5));
    search.add(2, uncertain(0.5 + 0.1 * tolerance, 0.6));
    search.finish();
    EXPECT_EQ(search.ids(), (Ids{1, 2}));
    expect_same(search.tau_of(2), uncertain(0.5 + 0.1 * tolerance, 1));
}

} // namespace
} // namespace chasles::search
