// A search whose later stages answer from a table, for tests of the rules of candidates.
#pragma once

#include "chasles/search/candidates.h"

#include <gtest/gtest.h>
#include <map>
#include <set>
#include <string>

namespace chasles::search {

constexpr double tolerance = 1e-12;
constexpr double never = 2; ///< SearchState::proven_upper() where nothing is proven

inline FeasibleInterval proven(double lower, double upper) {
    return {lower, upper, true};
}
inline FeasibleInterval uncertain(double lower, double upper) {
    return {lower, upper, false};
}
/// A proven contact with a final bracket.
inline FeasibleInterval final_at(double lower) {
    return proven(lower, lower + 0.25 * tolerance);
}

/// The candidate number `id`.
inline Candidate candidate(std::uint32_t id, const FeasibleInterval& tau) {
    return {{ContactKind::vertex_face, {id, id}, {0, 0}}, tau};
}

/// Stages that record every call and answer from tables. A candidate without an entry keeps its bracket.
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

/// One search with table stages, and its answer.
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

constexpr SearchGoal first_contact_goal{.tolerance = tolerance};
constexpr SearchGoal any_contact{.is_any_contact = true, .tolerance = tolerance};
/// As for distances.
constexpr SearchGoal start_tested_apart{.tolerance = tolerance, .start_is_tested_apart = true};

inline void expect_same(const FeasibleInterval& found, const FeasibleInterval& expected) {
    EXPECT_EQ(found.lower, expected.lower);
    EXPECT_EQ(found.upper, expected.upper);
    EXPECT_EQ(found.certain, expected.certain);
}

} // namespace chasles::search
