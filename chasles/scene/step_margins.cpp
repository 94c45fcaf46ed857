#include "chasles/scene/step_margins.h"

#include "chasles/query/requirements.h"

#include <algorithm>

namespace chasles::scene {

StepMargins::StepMargins(const Scene& scene, const StepOptions& options)
    : scene_(scene), margin_(options.margin), reach_(options.reach), all_(scene.margins(options.margin)) {
    query::require(margin_ > 0, "margin", "must be positive for a step");
    query::require(least() > 0, "margin", "of a pair or a group must be positive for a step");
    query::require(reach_ == 0 || reach_ >= 1.001 * largest(), "reach", "must be at least 1.001 times the margin");
    query::check_options({.margin = std::max(margin_, reach_), .time_tolerance = options.time_tolerance});
}

} // namespace chasles::scene
