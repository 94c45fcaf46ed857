// The candidates of one search, from what the filter finds to the answer. The same rules serve "touch" and "within a
// distance"; the stages that decide a candidate are the caller's.
// Source: docs/derivations/07-swept-boxes.md, "Best", "Second stage" and "Third stage".
#pragma once

#include "chasles/search/search_rules.h"

#include <concepts>
#include <optional>
#include <utility>
#include <vector>

namespace chasles::search {

/// The stages after the filter.
template <class S>
concept LaterStages = requires(S stages, const Candidate& candidate, const SearchState& state) {
    /// The filter's answer is proof enough for now; its bracket may be wide.
    { stages.is_proven(candidate) } -> std::same_as<bool>;
    /// A later stage has decided these features for the whole piece.
    { stages.is_settled(candidate) } -> std::same_as<bool>;
    /// The contact as later stages see it; empty if there is none, or none before state.best().
    { stages.decide(candidate, state) } -> std::same_as<std::optional<FeasibleInterval>>;
    /// A proven contact with a narrower bracket; the same bracket if it cannot be narrowed; empty if it is after
    /// state.best().
    { stages.narrow(candidate, state) } -> std::same_as<std::optional<FeasibleInterval>>;
};

class Candidates {
public:
    explicit Candidates(const SearchGoal& goal) : state_(goal) {}

    [[nodiscard]] const SearchState& state() const { return state_; }

    /// Takes in what the filter found, in terms of the whole piece. Intervals are to be searched in order.
    template <LaterStages Stages>
    void add(const Candidate& candidate, Stages& stages);
    /// Takes in what needs no further stage.
    void keep(const Candidate& candidate);

    /// The number of candidates nearly simultaneous with a proven contact, as far as the filter can tell.
    [[nodiscard]] std::size_t simultaneous() const { return simultaneous_; }
    /// Narrows the first proven contact to within the tolerance. Returns a time just before the contact, from which on
    /// a bracket is narrow enough; empty if that is not possible, or at the start.
    template <LaterStages Stages>
    std::optional<double> early_enough(Stages& stages);
    /// Lets the answer begin at that time at the latest, and drops candidates that start later.
    void stop_search_at(double tau);
    [[nodiscard]] double best() const { return std::min(state_.best(), searched_until_); }
    [[nodiscard]] double searched_until() const { return searched_until_; }
    /// No candidate starts before this tau.
    [[nodiscard]] double first() const;

    /// An overlap at the start: nothing is earlier.
    void end_at_start();

    /// After the last interval: narrows the brackets that matter and decides the candidates that were postponed.
    template <LaterStages Stages>
    void settle(Stages& stages);
    /// The candidates of the answer, after settle(). Once, and last.
    std::vector<Candidate> take();

private:
    /// The part of the tolerance before a contact that is not searched where many features touch at once.
    static constexpr double unsearched_part = 0.75;

    std::vector<Candidate>::iterator first_proven();
    std::vector<Candidate> in_order_of_proof();
    [[nodiscard]] FeasibleInterval with_proven_end(const FeasibleInterval& tau) const;
    [[nodiscard]] bool is_wide(const Candidate& candidate) const {
        return candidate.tau.certain && candidate.tau.upper > 0 && !state_.is_final(candidate.tau);
    }
    template <LaterStages Stages>
    void keep_narrowed(Stages& stages);
    template <LaterStages Stages>
    void decide_postponed(Stages& stages);

    SearchState state_;
    std::vector<Candidate> kept_;
    std::vector<Candidate> postponed_;
    std::size_t simultaneous_ = 0;
    double searched_until_ = 1;
};

template <LaterStages Stages>
void Candidates::add(const Candidate& candidate, Stages& stages) {
    if (state_.is_over() || candidate.tau.lower > best())
        return;
    const bool is_simultaneous = state_.is_nearly_simultaneous_with_proven(candidate.tau);
    simultaneous_ += is_simultaneous ? 1 : 0;
    if (stages.is_proven(candidate))
        return keep(candidate);
    if (is_simultaneous)
        return postponed_.push_back(candidate);
    if (state_.is_after_proven(candidate.tau) || stages.is_settled(candidate))
        return;
    if (const auto tau = stages.decide(candidate, state_))
        keep({candidate, *tau});
}

template <LaterStages Stages>
std::optional<double> Candidates::early_enough(Stages& stages) {
    const auto first = first_proven();
    if (first == kept_.end() || !(first->tau.certain && first->tau.lower > 0))
        return std::nullopt;
    if (!state_.is_final(first->tau))
        if (const auto narrow = stages.narrow(*first, state_); narrow && state_.is_final(*narrow)) {
            first->tau = *narrow;
            state_.note(*narrow);
        }
    const double early = first->tau.upper - unsearched_part * state_.goal().tolerance;
    return state_.is_final(first->tau) && early > 0 ? std::optional(early) : std::nullopt;
}

template <LaterStages Stages>
void Candidates::settle(Stages& stages) {
    keep_narrowed(stages);
    decide_postponed(stages);
}

template <LaterStages Stages>
void Candidates::keep_narrowed(Stages& stages) {
    for (const Candidate& candidate : in_order_of_proof()) {
        if (candidate.tau.lower > state_.best())
            continue;
        if (!is_wide(candidate))
            keep({candidate, with_proven_end(candidate.tau)});
        else if (const auto narrow = stages.narrow(candidate, state_))
            keep({candidate, *narrow});
    }
}

template <LaterStages Stages>
void Candidates::decide_postponed(Stages& stages) {
    for (const Candidate& candidate : postponed_) {
        if (candidate.tau.lower > state_.best() || state_.is_after_proven(candidate.tau))
            continue;
        if (state_.is_within_tolerance_of_proven(candidate.tau))
            keep({candidate, with_proven_end(candidate.tau)});
        else if (const auto tau = stages.decide(candidate, state_))
            keep({candidate, with_proven_end(*tau)});
    }
}

} // namespace chasles::search
