#include "chasles/search/start_overlaps.h"

#include "chasles/contact/crossing_faces.h"

#include <algorithm>

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
    auto result = refined(overlap, *refinement_, context_.piece().cubic());
    if (!result)
        return;
    result->certain = result->certain || is_between_crossing_faces(overlap);
    if (result->certain)
        found_ = result;
    else
        uncertain_.push_back(*result);
}

bool StartOverlaps::is_between_crossing_faces(const Overlap& overlap) {
    if (!start_)
        start_.emplace(context_.configuration_at(0));
    const double error = elementary::position_error<double>(scale_);
    const Body& body = overlap.edge_is_moving ? context_.moving() : context_.fixed();
    return std::ranges::any_of(body.faces_around(overlap.edge.first), [&](std::uint32_t face) {
        const auto corners = body.face(face);
        const std::uint32_t other = overlap.face.first;
        return std::ranges::find(corners, overlap.edge.second) != corners.end() &&
               contact::are_crossing(*start_, overlap.edge_is_moving ? face : other,
                                     overlap.edge_is_moving ? other : face, error);
    });
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
