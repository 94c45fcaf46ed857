#include "chasles/query/exact_stage.h"

#include "chasles/algebra/exact_feasible.h"

namespace chasles::query {

ExactStage::ExactStage(const Polyhedron& moving, const Polyhedron& fixed, const MotionFrame& frame)
    : motion_(motion::exact_motion(frame)), pairs_(moving, fixed, {}) {}

std::optional<FeasibleInterval> ExactStage::first_contact_of(const Candidate& candidate, double tolerance) {
    pairs_.use(motion_.maps, {tolerance, tolerance});
    return query::first_contact_of(pairs_, candidate);
}

bool ExactStage::passes(const Overlap& overlap) {
    pairs_.use(motion_.maps, {});
    return passage_of(pairs_, overlap, elementary::Ends::proven_opposite).has_value();
}

} // namespace chasles::query
