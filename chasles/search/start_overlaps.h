// The edges that pass through faces at the start, collected while a search goes on and decided when it ends. An edge
// may pass through a face at its rim, where a face of the edge passes through the inside. Source:
// docs/derivations/05-being-inside.md, last section.
#pragma once

#include "chasles/contact/relative_configuration.h"
#include "chasles/search/exact_stage.h"
#include "chasles/search/find.h"
#include "chasles/search/overlaps.h"
#include "chasles/search/piece_context.h"

#include <memory>
#include <optional>
#include <vector>

namespace chasles::search {

/// The overlap at the start of one search.
class StartOverlaps {
public:
    /// Both are kept by reference.
    StartOverlaps(PieceContext& context, const elementary::ErrorScale& scale) : context_(context), scale_(scale) {}
    StartOverlaps(const StartOverlaps&) = delete;
    StartOverlaps& operator=(const StartOverlaps&) = delete;

    /// Refines what the filter finds between two faces. True if a certain overlap is known.
    bool collect(FeatureTests<double>& filter, const TwoFaces& faces);
    /// Whether two faces are proven to pass through each other, in double. Bodies of one height may have no edge that
    /// passes through the inside of a face (docs/derivations/05-being-inside.md, "A face through a face at the start").
    bool collect_crossing(const TwoFaces& faces);
    /// Decides the uncertain overlaps in exact arithmetic, until one is certain. True if there is an overlap.
    ///
    /// Without exact maps, an uncertain overlap stays in the answer. No other test finds an edge that passes through
    /// the inside of a flat part.
    bool decide();

    [[nodiscard]] const std::optional<Overlap>& found() const { return found_; }
    [[nodiscard]] const Work& work() const { return work_; }

private:
    void refine(const Overlap& overlap);
    /// An edge around a face of one body that passes through a face of the other one, also at its rim.
    std::optional<Overlap> passing_edge(bool edge_is_moving, const TwoFaces& faces);
    FeatureTests<algebra::DoubleDouble>& refinement();

    PieceContext& context_;
    const elementary::ErrorScale& scale_;
    std::unique_ptr<FeatureTests<algebra::DoubleDouble>> refinement_; ///< made on the first use
    std::optional<RefinedStart> enclosed_start_;                      ///< of the refinement, on an enclosed motion
    std::optional<contact::RelativeConfiguration> start_;             ///< made on the first use
    std::optional<Overlap> found_;
    std::vector<Overlap> uncertain_;
    Work work_;
};

} // namespace chasles::search
