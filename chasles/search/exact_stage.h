// The last stage of a search: decides one feature pair in exact arithmetic, on the doubles as they were given.
// Source: docs/derivations/12-exact-stage.md.
#pragma once

#include "chasles/algebra/exact_feasible.h"
#include "chasles/search/candidate.h"
#include "chasles/search/feature_tests.h"

namespace chasles::search {

/// One piece of motion, exactly.
class ExactStage {
public:
    /// The maps are kept by reference.
    ExactStage(const Body& moving, const Body& fixed, const motion::ControlMaps<algebra::ExactNumber>& maps)
        : maps_(maps), tests_(moving, fixed, {}) {}

    /// The first contact of the features, empty if there is none. It is certain, and its bracket narrower than
    /// `tolerance`, unless the corners of its face are not exactly in one plane.
    std::optional<FeasibleInterval> first_contact_of(const FeaturePair& features, double tolerance);

    /// Whether the overlap's edge passes through its face at the start, its ends strictly on either side.
    bool passes(const Overlap& overlap);

private:
    const motion::ControlMaps<algebra::ExactNumber>& maps_;
    FeatureTests<algebra::ExactNumber> tests_;
};

} // namespace chasles::search
