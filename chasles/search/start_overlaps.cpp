#include "chasles/search/start_overlaps.h"

namespace chasles::search {

bool StartOverlaps::collect(FeatureTests<double>& filter, const TwoFaces& faces) {
    for_each_possible_overlap(filter, context_.moving(), context_.fixed(), faces,
                              [&](const Overlap& overlap) { refine(overlap); });
    return found_.has_value();
}

void StartOverlaps::refine(const Overlap& overlap) {
    if (found_)
        return;
    ++work_.refined;
    if (!refinement_) {
        refinement_ =
            std::make_unique<FeatureTests<algebra::DoubleDouble>>(context_.moving(), context_.fixed(), scale_);
        refinement_->use(context_.refined_maps(), {});
    }
    const auto result = refined(overlap, *refinement_, context_.piece().cubic());
    if (!result)
        return;
    if (result->certain)
        found_ = result;
    else
        uncertain_.push_back(*result);
}

bool StartOverlaps::decide() {
    if (found_ || uncertain_.empty())
        return found_.has_value();
    const auto* maps = context_.exact_maps();
    if (maps == nullptr) {
        found_ = uncertain_.front();
        return true;
    }
    ExactStage exact(context_.moving(), context_.fixed(), *maps);
    for (Overlap& overlap : uncertain_) {
        ++work_.exact;
        if (exact.passes(overlap)) {
            overlap.certain = true;
            found_ = overlap;
            return true;
        }
    }
    return false;
}

} // namespace chasles::search
