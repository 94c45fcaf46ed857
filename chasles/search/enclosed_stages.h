// When do features touch, or come within a distance, on a motion that the maps only enclose? A filter over a part of
// the piece, then the same test over ever shorter parts, which deviate less and less. Source:
// docs/derivations/24-enclosures.md, "Refinement".
#pragma once

#include "chasles/search/candidates.h"
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
    /// The tests over one part of the piece.
    class PartTests {
    public:
        PartTests(PieceContext& context, const SearchOptions& options, const culling::PieceParts& parts)
            : tests_(context.moving(), context.fixed(), parts.scale(), options.margin), maps_(parts),
              tolerance_(options.tolerance) {}

        void use(const culling::TimeRange& part);
        /// In terms of the whole piece.
        std::optional<FeasibleInterval> first(const FeaturePair& features);
        [[nodiscard]] FeatureTests<double>& tests() { return tests_; }
        [[nodiscard]] const culling::TimeRange& part() const { return maps_.part(); }
        [[nodiscard]] bool is_worth_shortening() const { return maps_.is_worth_shortening(); }
        [[nodiscard]] const elementary::Workspace<double>& workspace() const { return tests_.workspace(); }

    private:
        FeatureTests<double> tests_;
        culling::PartMaps maps_;
        double tolerance_;
    };

    /// Likewise in double-double.
    class RefinedPartTests {
    public:
        RefinedPartTests(PieceContext& context, const SearchOptions& options, const culling::PieceParts& parts)
            : tests_(context.moving(), context.fixed(), parts.scale(), options.margin), piece_(context.piece()),
              parts_(parts), tolerance_(options.tolerance) {}

        void use(const culling::TimeRange& part);
        std::optional<FeasibleInterval> first(const FeaturePair& features);
        [[nodiscard]] FeatureTests<algebra::DoubleDouble>& tests() { return tests_; }
        [[nodiscard]] bool is_worth_shortening() const { return parts_.is_worth_shortening(bounds_); }

    private:
        FeatureTests<algebra::DoubleDouble> tests_;
        const motion::AnyPiece& piece_;
        culling::PieceParts parts_;
        double tolerance_;
        culling::TimeRange part_;
        motion::EnclosureBounds bounds_;
        motion::ControlMaps<algebra::DoubleDouble> maps_;
    };

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
    PartTests filter_;
    PartTests shorter_;
    std::unique_ptr<RefinedPartTests> refinement_; ///< made on the first use
    FeatureTests<double> start_tests_;
    StartOverlaps overlaps_;
    Candidates candidates_;
    bool is_at_start_ = false;
    bool is_settling_ = false;
    std::vector<culling::TimeRange> later_; ///< parts that wait for their refinement, the earliest last
    Work work_;
};

extern template class EnclosedStages<false>;
extern template class EnclosedStages<true>;

} // namespace chasles::search
