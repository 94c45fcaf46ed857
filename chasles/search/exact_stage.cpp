#include "chasles/search/exact_stage.h"

namespace chasles::search {

std::optional<FeasibleInterval> ExactStage::first_contact_of(const FeaturePair& features, double tolerance) {
    tests_.use(maps_, {tolerance, tolerance});
    return tests_.touch(features);
}

bool ExactStage::passes(const Overlap& overlap) {
    tests_.use(maps_, {});
    return tests_.passage(overlap, elementary::Ends::proven_opposite).has_value();
}

} // namespace chasles::search
