// What the filter of a search with a margin found, and what double-double makes of it. Source:
// docs/derivations/16-margin.md, "Stages", and 17-hold.md.
#pragma once

#include "chasles/contact/relative_configuration.h"
#include "chasles/search/near_pairs.h"
#include "chasles/search/near_search.h"
#include "chasles/search/piece_context.h"

namespace chasles::search {

/// Maps over any part of a piece, and the detections under them.
template <class S>
class NearStage {
public:
    /// The maps of the whole piece are kept by reference.
    NearStage(const PieceSearch& search, const elementary::ErrorScale& scale, const motion::ControlMaps<S>& whole)
        : whole_(whole), pairs_(search.moving, search.fixed, scale, search.margin) {}

    void use(const culling::TimeRange& part) {
        part_ = part;
        maps_ = part == culling::TimeRange() ? whole_ : motion::restricted(whole_, S(part.lower), S(part.upper));
        pairs_.use(maps_);
    }
    [[nodiscard]] NearPairs<S>& pairs() { return pairs_; }
    [[nodiscard]] const culling::TimeRange& part() const { return part_; }

    /// The first crossing in the part, in terms of the whole piece.
    std::optional<Crossing> first_crossing(const contact::FeaturePair& features, const algebra::Tolerance& tolerance) {
        FirstCrossing ask(tolerance);
        pairs_.pair(features, [&](const auto& problem) { ask(problem); });
        return in_piece(ask.first(), part_);
    }

    /// Ends of brackets are rounded outward.
    static std::optional<Crossing> in_piece(std::optional<Crossing> crossing, const culling::TimeRange& part) {
        constexpr double rounding = 0x1p-51;
        if (crossing) {
            FeasibleInterval& tau = crossing->tau;
            tau.lower = std::max(part.lower, part.at(tau.lower) * (1 - rounding));
            tau.upper = std::min(part.upper, part.at(tau.upper) * (1 + rounding));
        }
        return crossing;
    }

private:
    const motion::ControlMaps<S>& whole_;
    culling::TimeRange part_{0, 0};
    motion::ControlMaps<S> maps_;
    NearPairs<S> pairs_;
};

/// The candidates of one search with a margin.
class FoundNear {
public:
    /// Both are kept by reference.
    FoundNear(const PieceSearch& search, const PieceContext& numbers)
        : search_(search), numbers_(numbers), filter_(search, numbers.scale, numbers.maps) {}

    /// A crossing that the filter found, in terms of the whole piece.
    void add(const contact::FeaturePair& features, const Crossing& crossing);
    /// Features that may be within the margin at the start.
    void add_at_start(const contact::FeaturePair& features, WithinAtStart::Answer answer);
    void add(const Overlap& overlap);

    /// Nothing after this matters.
    [[nodiscard]] double best() const { return best_; }
    /// Nothing at all does any more.
    [[nodiscard]] bool is_over() const { return stop_; }

    /// Once, and last.
    PieceResult take();

private:
    [[nodiscard]] bool is_decided(const FeasibleInterval& tau) const;
    [[nodiscard]] bool is_nearly_simultaneous_with_proven(const FeasibleInterval& tau) const;
    [[nodiscard]] bool is_within_tolerance_of_proven(const FeasibleInterval& tau) const;
    [[nodiscard]] FeasibleInterval without_doubtful_end(const FeasibleInterval& tau) const;
    [[nodiscard]] std::optional<double> passed_until(const contact::FeaturePair& features,
                                                     const Crossing& crossing) const;
    std::optional<FeasibleInterval> first_that_counts(const contact::FeaturePair& features, const Crossing& found);
    std::optional<Crossing> refined(const contact::FeaturePair& features, const culling::TimeRange& where);
    void keep(const contact::FeaturePair& features, const FeasibleInterval& tau);
    void narrow_brackets();

    /// The second stage, made when it is first asked.
    struct Refinement {
        using Scalar = algebra::DoubleDouble;
        motion::ControlMaps<Scalar> maps;
        NearStage<Scalar> near;
        FeaturePairs<Scalar> touching;

        Refinement(const PieceSearch& search, const elementary::ErrorScale& scale)
            : maps(motion::control_maps(search.frame.motion)), near(search, scale, maps),
              touching(search.moving, search.fixed, {scale, {}}) {}
    };
    Refinement& refinement();

    const PieceSearch& search_;
    const PieceContext& numbers_;
    NearStage<double> filter_; ///< of what comes after a crossing that does not count
    std::unique_ptr<Refinement> refinement_;
    double best_ = 1;
    double certain_ = 2; ///< the least upper end of what is proven
    bool stop_ = false;
    std::vector<Candidate> waiting_; ///< in doubt, beside a proven contact
    PieceResult result_;
};

} // namespace chasles::search
