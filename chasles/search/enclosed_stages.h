// When do features touch, or come within a distance, on a motion that the maps only enclose? A filter over a part of
// the piece, then the same test over ever shorter parts, which deviate less and less. Source:
// docs/derivations/24-enclosures.md, "Refinement".
#pragma once

#include "chasles/base/limit_of_thread.h"
#include "chasles/search/candidates.h"
#include "chasles/search/distance_crossing.h"
#include "chasles/search/feature_tests.h"
#include "chasles/search/piece_search.h"
#include "chasles/search/start_overlaps.h"

#include <memory>
#include <vector>

namespace chasles::search {

/// The stages of one search on an enclosed motion. `within_margin`: for features that come within a distance, not for
/// those that touch.
template <bool within_margin>
class EnclosedStages {
public:
    /// Both are kept by reference.
    EnclosedStages(PieceContext& context, const SearchOptions& options);

    static constexpr bool tests_all_kinds = within_margin;
    [[nodiscard]] const culling::PieceParts& parts() const { return parts_; }
    [[nodiscard]] double culling_margin() const;
    [[nodiscard]] double best() const { return candidates_.best(); }
    [[nodiscard]] double first_candidate() const { return candidates_.first(); }
    [[nodiscard]] bool is_over() const { return candidates_.state().is_over(); }

    void use(const culling::TimeRange& part);
    void test_start(const TwoFaces& faces);
    void test(const FeaturePair& features);

    /// Features that touch at once are not separated by a plane.
    static std::optional<double> early_enough() { return std::nullopt; }
    void stop_search_at(double tau) { candidates_.stop_search_at(tau); }

    /// Once, and last.
    PieceResult take();

    // The functions that Candidates requires of the later stages.
    [[nodiscard]] static bool is_proven(const Candidate& candidate) {
        return candidate.tau.certain && candidate.tau.lower > 0;
    }
    [[nodiscard]] static bool is_settled(const Candidate&) { return false; }
    std::optional<FeasibleInterval> decide(const Candidate& candidate, const SearchState& state);
    std::optional<FeasibleInterval> narrow(const Candidate& candidate, const SearchState& state);

private:
    /// The tests over one part of the piece, in double or in double-double.
    template <class S>
    class PartTests {
    public:
        PartTests(PieceContext& context, const SearchOptions& options, const culling::PieceParts& parts)
            : tests_(context.moving(), context.fixed(), parts.scale(), options.margin), piece_(context.piece()),
              parts_(parts), time_tolerance_(options.tolerance) {}

        void use(const culling::TimeRange& part);
        /// In terms of the whole piece.
        std::optional<FeasibleInterval> first(const FeaturePair& features);
        /// Whether they are within the margin at the start of the part.
        WithinAtStart::Answer within_at_start(const FeaturePair& features);

        [[nodiscard]] const culling::TimeRange& part() const { return part_; }
        [[nodiscard]] bool is_worth_shortening() const { return parts_.is_worth_shortening(bounds_); }
        [[nodiscard]] const elementary::Workspace<S>& workspace() const { return tests_.workspace(); }

    private:
        FeatureTests<S> tests_;
        const motion::AnyPiece& piece_;
        culling::PieceParts parts_;
        double time_tolerance_;
        culling::TimeRange part_{0, 0}; ///< empty before the first call of `use`
        algebra::Tolerance tolerance_;  ///< in the part
        motion::EnclosureBounds bounds_;
        motion::ControlMaps<S> maps_;
    };
    using RefinedTests = PartTests<algebra::DoubleDouble>;

    template <class Tests>
    std::optional<FeasibleInterval> follow(Tests& tests, const FeaturePair& features, const FeasibleInterval& where,
                                           const SearchState& state);
    bool can_refine();
    std::optional<FeasibleInterval> refine(const FeaturePair& features, const FeasibleInterval& where,
                                           const SearchState& state);
    void test_at_start(const FeaturePair& features);

    PieceContext& context_;
    const SearchOptions& options_;
    culling::PieceParts parts_;
    culling::TimeRange part_;
    PartTests<double> filter_;
    PartTests<double> shorter_;
    std::unique_ptr<RefinedTests> refinement_; ///< made on the first use
    FeatureTests<double> start_tests_;
    StartOverlaps overlaps_;
    Candidates candidates_;
    bool is_at_start_ = false;
    bool is_settling_ = false;
    int spare_refinements_ = 1 << 19;       ///< for features that stay near each other
    std::vector<culling::TimeRange> later_; ///< parts that wait for their refinement, the earliest last
    Work work_;
    Watch watch_;
};

/// The search of a piece whose motion is enclosed.
PieceResult search_enclosed_piece(PieceContext& context, const SearchOptions& options);

extern template class EnclosedStages<false>;
extern template class EnclosedStages<true>;

} // namespace chasles::search
