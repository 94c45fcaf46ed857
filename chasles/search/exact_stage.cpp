#include "chasles/search/exact_stage.h"

#include "chasles/algebra/exact_feasible.h"

namespace chasles::search {

ExactStage::ExactStage(const Body& moving, const Body& fixed, const MotionFrame& frame)
    : motion_(motion::exact_motion(frame)), pairs_(moving, fixed, {}) {}

std::optional<FeasibleInterval> ExactStage::first_contact_of(const Candidate& candidate, double tolerance) {
    pairs_.use(motion_.maps, {tolerance, tolerance});
    return search::first_contact_of(pairs_, candidate);
}

bool ExactStage::passes(const Overlap& overlap) {
    pairs_.use(motion_.maps, {});
    return passage_of(pairs_, overlap, elementary::Ends::proven_opposite).has_value();
}

} // namespace chasles::search
