#include "chasles/search/start_overlaps.h"

#include "chasles/contact/crossing_faces.h"

#include <algorithm>

namespace chasles::search {

bool StartOverlaps::collect(FeatureTests<double>& filter, const TwoFaces& faces) {
    for_each_possible_overlap(filter, context_.moving(), context_.fixed(), faces,
                              [&](const Overlap& overlap) { refine(overlap); });
    return found_.has_value();
}

FeatureTests<algebra::DoubleDouble>& StartOverlaps::refinement() {
    if (refinement_)
        return *refinement_;
    refinement_ = std::make_unique<FeatureTests<algebra::DoubleDouble>>(context_.moving(), context_.fixed(), scale_);
    enclosed_start_ = context_.refined_start();
    if (enclosed_start_)
        refinement_->use(enclosed_start_->maps, enclosed_start_->scale, {});
    else
        refinement_->use(context_.refined_maps(), {});
    return *refinement_;
}

void StartOverlaps::refine(const Overlap& overlap) {
    if (found_)
        return;
    ++work_.refined;
    const auto result = refined(overlap, refinement(), context_.piece().cubic());
    if (!result)
        return;
    if (result->certain)
        found_ = result;
    else
        uncertain_.push_back(*result);
}

bool StartOverlaps::collect_crossing(const TwoFaces& faces) {
    if (!start_)
        start_.emplace(context_.configuration_at(0));
    if (found_ ||
        !contact::are_crossing(*start_, faces.moving, faces.fixed, elementary::position_error<double>(scale_)))
        return found_.has_value();
    found_ = passing_edge(true, faces);
    if (!found_)
        found_ = passing_edge(false, faces);
    return found_.has_value();
}

std::optional<Overlap> StartOverlaps::passing_edge(bool edge_is_moving, const TwoFaces& faces) {
    const Body& body = edge_is_moving ? context_.moving() : context_.fixed();
    const std::uint32_t other = edge_is_moving ? faces.fixed : faces.moving;
    const auto corners = body.face(edge_is_moving ? faces.moving : faces.fixed);
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const auto [from, to] = std::minmax(corners[i], corners[(i + 1) % corners.size()]);
        ++work_.refined;
        auto passing = refined({edge_is_moving, {from, to}, {other, other}, Eigen::Vector3d::Zero(), false},
                               refinement(), context_.piece().cubic());
        if (passing) {
            passing->certain = true;
            return passing;
        }
    }
    return std::nullopt;
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
