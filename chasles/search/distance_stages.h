// When do features come within a distance? The two stages: a filter in double and a refinement in double-double, each
// over a part of the piece. Distances have no exact stage (docs/decisions/0050-margin-in-double-double.md).
// Source: docs/derivations/16-margin.md, "Stages".
#pragma once

#include "chasles/search/candidates.h"
#include "chasles/search/distance_crossing.h"
#include "chasles/search/piece_search.h"
#include "chasles/search/start_overlaps.h"

#include <memory>

namespace chasles::search {

/// The stages of one search with a margin.
class DistanceStages {
public:
    /// Both are kept by reference.
    DistanceStages(PieceContext& context, const SearchOptions& options);

    static constexpr bool tests_all_kinds = true;
    [[nodiscard]] const culling::PieceParts& parts() const { return parts_; }
    [[nodiscard]] double culling_margin() const {
        return options_.margin + elementary::parallel_slack * parts_.scale().length;
    }
    [[nodiscard]] double best() const { return candidates_.best(); }
    [[nodiscard]] double first_candidate() const { return candidates_.first(); }
    [[nodiscard]] bool is_over() const { return candidates_.state().is_over(); }

    void use(const culling::TimeRange& part);
    void test_start(const TwoFaces& faces);
    void test(const FeaturePair& features);

    /// Flat contacts within a distance are not separated by a plane.
    static std::optional<double> early_enough() { return std::nullopt; }
    void stop_search_at(double tau) { candidates_.stop_search_at(tau); }

    /// Once, and last.
    PieceResult take();

    // The functions that Candidates requires of the later stages.
    [[nodiscard]] static bool is_proven(const Candidate& candidate) { return candidate.tau.certain; }
    [[nodiscard]] static bool is_settled(const Candidate&) { return false; }
    std::optional<FeasibleInterval> decide(const Candidate& candidate, const SearchState& state);
    std::optional<FeasibleInterval> narrow(const Candidate& candidate, const SearchState& state);

private:
    void test_at_start(const FeaturePair& features, WithinAtStart::Answer answer);
    std::optional<FeasibleInterval> next_crossing(const FeaturePair& features, double after);
    std::optional<FeasibleInterval> refined(const FeaturePair& features, const culling::TimeRange& where);
    std::optional<FeasibleInterval> in_double(const FeaturePair& features, const culling::TimeRange& part);
    std::optional<FeasibleInterval> in_double_double(const FeaturePair& features, const culling::TimeRange& where);
    PartTests<algebra::DoubleDouble>& refinement();

    PieceContext& context_;
    const SearchOptions& options_;
    culling::PieceParts parts_;
    PartTests<double> filter_;
    PartTests<double> next_filter_; ///< for short parts, and the time after a crossing that is none
    FeatureTests<double> start_tests_;
    std::unique_ptr<PartTests<algebra::DoubleDouble>> refinement_; ///< made on the first use
    StartOverlaps overlaps_;
    Candidates candidates_;
    bool is_at_start_ = false;
    Work work_;
};

} // namespace chasles::search
