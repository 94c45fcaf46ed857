// What the filter of one search found, and what later stages make of it: contacts that are proven, doubt that is
// decided, brackets that are narrowed when it is known which of them matter. Source:
// docs/derivations/07-swept-boxes.md, "Best", "Second stage" and "Third stage".
#pragma once

#include "chasles/search/exact_stage.h"
#include "chasles/search/piece_search.h"

#include <memory>
#include <set>

namespace chasles::search {

/// How the refinement in double-double searches: far below any clearance that doubles can describe, and first where the
/// filter found something.
inline algebra::Tolerance refinement_tolerance(double width, const FeasibleInterval& found) {
    constexpr double rim = 0x1p-45; // far above the rounding of `found` to the whole piece
    return {width, 0x1p-90, 12, {std::max(0.0, found.lower - rim), std::min(1.0, found.upper + rim)}};
}

/// The second stage: the same questions in double-double, over the whole piece.
struct Refinement {
    motion::ControlMaps<algebra::DoubleDouble> maps;
    FeaturePairs<algebra::DoubleDouble> pairs;

    Refinement(const PieceSearch& search, const elementary::ErrorScale& scale)
        : maps(motion::control_maps(search.frame.motion)), pairs(search.moving, search.fixed, {scale, {}}) {}
};

/// The candidates of one search.
class FoundContacts {
public:
    /// The search is kept by reference.
    FoundContacts(const PieceSearch& search, const elementary::ErrorScale& scale) : search_(search), scale_(scale) {}

    /// Takes in what the filter found, in terms of the whole piece, unless a later stage proves that it is none.
    /// Intervals are to be searched in order.
    void add(const Candidate& candidate);
    void add(const Overlap& overlap);

    /// Nothing after this matters.
    [[nodiscard]] double best() const { return std::min(best_, result_.open_after); }
    /// Nothing at all does any more.
    [[nodiscard]] bool is_over() const { return stop_; }

    /// How many were found at the time of a proven contact, as far as the filter can tell; 0 if all are asked for.
    [[nodiscard]] std::size_t at_once() const { return at_once_; }
    /// Narrows the first proven contact to within the tolerance and gives a time before it that is as near: to know
    /// that nothing is earlier than that is enough. None where that cannot be, or is at the start.
    std::optional<double> early_enough();
    /// Lets the answer begin at that time at the latest, and asks for nothing that is later.
    void leave_open_after(double tau);

    /// The maps of the whole piece.
    const motion::ControlMaps<algebra::DoubleDouble>& maps() { return refinement().maps; }

    /// Once, and last.
    PieceResult take();

private:
    std::vector<Candidate>::iterator first_proven();
    void keep(const Candidate& candidate);
    bool decide(Candidate& candidate);
    void narrow_brackets();
    void decide_overlaps();

    [[nodiscard]] bool is_decided(const FeasibleInterval& tau) const;
    [[nodiscard]] bool is_nearly_simultaneous_with_proven(const FeasibleInterval& tau) const;
    [[nodiscard]] bool is_after_proven(const FeasibleInterval& tau) const;
    [[nodiscard]] bool is_within_tolerance_of_proven(const FeasibleInterval& tau) const;

    FeaturePairs<algebra::DoubleDouble>& refined_pairs(const algebra::Tolerance& tolerance);
    Refinement& refinement();
    ExactStage& exact_stage();

    const PieceSearch& search_;
    elementary::ErrorScale scale_;
    std::optional<Refinement> refinement_;    ///< made when it is first asked
    std::unique_ptr<ExactStage> exact_stage_; ///< likewise, and large
    double best_ = 1;                         ///< an upper end of the first contact found so far
    std::size_t at_once_ = 0;
    Bracket certain_{2, 2}; ///< the least ends of contacts that are proven; lower ends once they are final
    bool stop_ = false;
    std::vector<Candidate> waiting_; ///< in doubt
    std::vector<Overlap> doubtful_overlaps_;
    /// The answers were for all of the piece, so that those of later intervals are known.
    std::set<contact::FeaturePair> asked_exactly_;
    PieceResult result_;
};

} // namespace chasles::search
