// The last stage of a query: decides one feature pair in exact arithmetic, on the doubles as they were given.
// Source: docs/derivations/12-exact-stage.md.
#pragma once

#include "chasles/motion/exact_motion.h"
#include "chasles/search/candidate.h"

namespace chasles::search {

/// One piece of motion, exactly.
class ExactStage {
public:
    ExactStage(const Body& moving, const Body& fixed, const MotionFrame& frame);

    /// The first contact of the candidate's features, empty if there is none. It is certain, and its bracket narrower
    /// than `tolerance`, unless the corners of its face are not exactly in one plane.
    std::optional<FeasibleInterval> first_contact_of(const Candidate& candidate, double tolerance);

    /// Whether the overlap's edge goes through its face at the start, its ends strictly on either side.
    bool passes(const Overlap& overlap);

private:
    motion::ExactMotion motion_;
    FeaturePairs<algebra::ExactNumber> pairs_;
};

} // namespace chasles::search
