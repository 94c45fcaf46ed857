#include "bench/peer_truth.h"

#include "bench/discrete_overlap.h"
#include "bench/piecewise_poses.h"
#include "chasles/query/first_contact.h"

#include <cmath>

namespace chasles::bench {

namespace {

/// Upper bound on the error in time of a construction whose poses are rounded.
constexpr double rounding_of_constructions = 1e-9;

std::string against_construction(const Truth& truth, const PeerAnswer& known) {
    if (known.touches != truth.touches)
        return "the verdict differs from the construction";
    if (known.time && std::abs(*known.time - truth.time.lower) > rounding_of_constructions)
        return "the time differs from the construction";
    return {};
}

std::string against_samples(const Truth& truth, const PeerCase& pair, const PiecewisePoses& poses) {
    const auto overlap_at = [&](double time) { return is_overlapping(pair.moving, pair.fixed, poses.at(time)); };
    const double last = truth.touches ? std::max(0.0, truth.time.lower - 1e-6) : 1;
    for (const double share : {0.0, 0.6, 1.0})
        if (overlap_at(share * last))
            return "the bodies overlap before the contact";
    if (truth.touches && !overlap_at(truth.time.upper + 1e-6))
        return "the bodies do not overlap after the contact";
    return {};
}

} // namespace

Truth truth_of(const PeerCase& pair, const PeerQuestion& question) {
    const ScrewMotion screw = ScrewMotion::between(question.motion.start, question.motion.goal);
    FirstContactQuery query{.moving = pair.moving, .fixed = pair.fixed, .motion = screw};
    const FirstContact first = first_contact(query);
    query.options.find = Find::any;
    const FirstContact any = first_contact(query);
    Truth truth{first.verdict != Verdict::clear, first.time, {}};
    if (first.verdict == Verdict::contact_at_start)
        truth.contradiction = "the bodies touch at the start";
    else if (any.verdict != first.verdict || (truth.touches && any.time.upper < first.time.lower))
        truth.contradiction = "the answer with Find::any contradicts the first contact";
    else if (question.known)
        truth.contradiction = against_construction(truth, *question.known);
    if (truth.contradiction.empty())
        truth.contradiction = against_samples(truth, pair, PiecewisePoses(screw));
    if (question.known && question.known->time)
        truth.time = {*question.known->time, *question.known->time};
    return truth;
}

} // namespace chasles::bench
