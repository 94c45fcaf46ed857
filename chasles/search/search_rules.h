// The rules by which a search weighs its candidates: what is final, what may wait, and what no longer matters. They
// hold for "the features touch" and for "the features come within a distance". Source:
// docs/derivations/07-swept-boxes.md, "Best", "Second stage" and "Third stage".
#pragma once

#include "chasles/algebra/bracket.h"
#include "chasles/search/candidate.h"

#include <algorithm>

namespace chasles::search {

/// What a search asks for.
struct SearchGoal {
    bool is_any_contact = false; ///< any contact, which need not be the first
    double tolerance = 1e-12;    ///< of tau
    /// Whether contact at tau = 0 is decided apart from contact after it, as distances are. Otherwise a bracket that
    /// begins at 0 is not final: contact at 0 and contact just after it have different verdicts.
    bool start_is_tested_apart = false;
    double until = 1; ///< contacts that begin after this tau do not matter
};

/// How far a search has come.
class SearchState {
public:
    explicit SearchState(const SearchGoal& goal) : goal_(goal), best_(goal.until) {}

    [[nodiscard]] const SearchGoal& goal() const { return goal_; }
    /// No candidate that starts after this time matters.
    [[nodiscard]] double best() const { return best_; }
    /// The search may stop: no further candidate can change the answer.
    [[nodiscard]] bool is_over() const { return is_over_; }

    /// The bracket proves a contact, is within the tolerance, and tells the verdict.
    [[nodiscard]] bool is_final(const FeasibleInterval& tau) const {
        return tau.certain && tau.upper - tau.lower <= goal_.tolerance &&
               (goal_.start_is_tested_apart || tau.lower > 0);
    }
    /// The candidate starts after the start of a proven contact whose bracket is final: it changes nothing.
    [[nodiscard]] bool is_after_proven(const FeasibleInterval& tau) const { return final_lower_ <= tau.lower; }
    /// A proven contact follows within the tolerance: whatever the candidate is, a bracket from its start to that
    /// contact is narrow enough.
    [[nodiscard]] bool is_within_tolerance_of_proven(const FeasibleInterval& tau) const {
        return proven_upper_ - tau.lower <= goal_.tolerance && (tau.lower > 0 || proven_upper_ <= 0);
    }
    /// An uncertain candidate may wait until the bracket of the proven contact is narrow.
    [[nodiscard]] bool is_nearly_simultaneous_with_proven(const FeasibleInterval& tau) const {
        return tau.lower > 0 && proven_upper_ - tau.lower <= nearly_simultaneous;
    }

    /// Takes account of a candidate that is kept.
    void note(const FeasibleInterval& tau) {
        best_ = std::min(best_, end_of_interest(tau));
        if (tau.certain)
            proven_upper_ = std::min(proven_upper_, tau.upper);
        if (is_final(tau))
            final_lower_ = std::min(final_lower_, tau.lower);
        const bool is_at_start = goal_.start_is_tested_apart ? tau.upper <= 0 : may_be_at_start(tau);
        const bool is_enough = goal_.is_any_contact && tau.upper <= goal_.until; // a narrower bracket may be too late
        is_over_ = is_over_ || is_enough || is_at_start;
    }
    /// A proven contact before `tau`, which is not kept.
    void shorten(double tau) { best_ = std::min(best_, tau); }
    void stop() { is_over_ = true; }
    /// Before brackets are narrowed: no candidate is to be compared with itself.
    void forget_proven() { proven_upper_ = final_lower_ = never; }
    [[nodiscard]] double proven_upper() const { return proven_upper_; }

private:
    static constexpr double never = 2; ///< after every tau

    /// A later candidate may prove an uncertain one's contact within the tolerance, and then ends the bracket.
    [[nodiscard]] double end_of_interest(const FeasibleInterval& tau) const {
        const bool may_be_proven_soon = !tau.certain && tau.upper > 0;
        return may_be_proven_soon ? std::max(tau.upper, tau.lower + goal_.tolerance) : tau.upper;
    }

    SearchGoal goal_;
    double best_;
    double proven_upper_ = never; ///< the least upper end of a proven contact
    double final_lower_ = never;  ///< the least lower end of a proven contact with a final bracket
    bool is_over_ = false;
};

} // namespace chasles::search
