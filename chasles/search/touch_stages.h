// When do features touch? The three stages: a filter in double over a part of the piece, a refinement in double-double
// and a decision in exact arithmetic, both over the whole piece.
// Source: docs/derivations/07-swept-boxes.md, "Second stage" and "Third stage".
#pragma once

#include "chasles/search/candidates.h"
#include "chasles/search/exact_stage.h"
#include "chasles/search/piece_search.h"
#include "chasles/search/start_overlaps.h"

#include <memory>
#include <set>

namespace chasles::search {

/// How the filter in double searches for brackets of this width in tau. Its steps are limited to what ordinary tests
/// need: harder problems cost less in the next stage. The limit never changes an answer (benchmarks: elementary_bench
/// and worst_elementary_bench).
inline algebra::Tolerance filter_tolerance(double width) {
    return {width, width, 40};
}

/// How the refinement in double-double searches: far below any clearance that doubles can describe, and first where the
/// filter found something.
inline algebra::Tolerance refinement_tolerance(double width, const FeasibleInterval& found) {
    constexpr double rim = 0x1p-45; // far above the rounding of `found` to the whole piece
    return {width, 0x1p-90, 12, {std::max(0.0, found.lower - rim), std::min(1.0, found.upper + rim)}};
}

/// The stages of one search for features that touch.
class TouchStages {
public:
    /// Both are kept by reference.
    TouchStages(PieceContext& context, const SearchOptions& options);

    /// Edges near vertices and vertices near vertices touch as one of the other three kinds.
    static constexpr bool tests_all_kinds = false;
    /// The piece of this search.
    [[nodiscard]] const culling::PieceParts& parts() const { return parts_; }
    /// How far points may be from a plane and still count as reaching it.
    [[nodiscard]] double culling_margin() const { return 0; }
    /// No candidate after this time matters; nothing matters at all any more.
    [[nodiscard]] double best() const { return candidates_.best(); }
    [[nodiscard]] double first_candidate() const { return candidates_.first(); }
    [[nodiscard]] bool is_over() const { return candidates_.state().is_over(); }

    /// Sets the part of the piece that the filter tests next.
    void use(const culling::TimeRange& part);
    void test_start(const TwoFaces& faces);
    void test(const FeaturePair& features);

    /// Many features that touch at once: a time just before, until which they may be separated by one plane. Narrows
    /// the first contact for it; empty if there are few features, or no such time.
    std::optional<double> early_enough();
    void stop_search_at(double tau) { candidates_.stop_search_at(tau); }

    /// Once, and last.
    PieceResult take();

    // The functions that Candidates requires of the later stages.
    [[nodiscard]] bool is_proven(const Candidate& candidate) const {
        return candidate.tau.certain && candidate.tau.lower > 0;
    }
    [[nodiscard]] bool is_settled(const Candidate& candidate) const { return decided_exactly_.contains(candidate); }
    std::optional<FeasibleInterval> decide(const Candidate& candidate, const SearchState& state);
    std::optional<FeasibleInterval> narrow(const Candidate& candidate, const SearchState& state);

private:
    std::optional<FeasibleInterval> decide_exactly(const FeaturePair& features, const FeasibleInterval& refined);
    FeatureTests<algebra::DoubleDouble>& refinement(const algebra::Tolerance& tolerance);
    ExactStage* exact_stage();

    PieceContext& context_;
    const SearchOptions& options_;
    culling::PieceParts parts_;
    FeatureTests<double> filter_;
    culling::PartMaps filter_maps_;
    culling::TimeRange part_;
    std::unique_ptr<FeatureTests<algebra::DoubleDouble>> refinement_; ///< made on the first use
    std::unique_ptr<ExactStage> exact_stage_;                         ///< likewise, and large
    StartOverlaps overlaps_;
    Candidates candidates_;
    /// Their answers hold for all of the piece, so also for later intervals.
    std::set<FeaturePair> decided_exactly_;
    std::size_t many_ = 4; ///< simultaneous candidates from which on a plane is worth searching for
    Work work_;
};

} // namespace chasles::search
