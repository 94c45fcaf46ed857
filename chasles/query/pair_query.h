// One question about one pair of bodies, piece by piece of the motion.
#pragma once

#include "chasles/mesh/body.h"
#include "chasles/motion/any_trajectory.h"
#include "chasles/query/first_contact.h"
#include "chasles/query/least_distance.h"
#include "chasles/query/lower_envelope.h"
#include "chasles/search/memory.h"

namespace chasles::query {

/// A question by reference: batches answer many of them without copying bodies.
struct PairQuery {
    const Body& moving;
    const Body& fixed;
    const motion::AnyTrajectory& trajectory;
    const QueryOptions& options;
    double until = 1;                             ///< time in [0, 1]: contacts that begin later need not be found
    search::Memory& memory = search::no_memory(); ///< of both bodies, for questions that follow each other
};

/// Likewise for the least distance.
struct LeastPairQuery {
    const Body& moving;
    const Body& fixed;
    const motion::AnyTrajectory& trajectory;
    const LeastDistanceOptions& options;
};

/// Likewise for the profile, which need not be close where other distances are less.
struct PairProfileQuery {
    const Body& moving;
    const Body& fixed;
    const motion::AnyTrajectory& trajectory;
    const ProfileOptions& options;
    const LowerEnvelope& others = LowerEnvelope::none();
    Bracket part = {0, 1}; ///< of the time of the others: the time of the motion
};

/// The answer, for options that have been checked. Throws InvalidInput for a motion that is refused, and Cancelled at
/// the limit of the thread: what asks about many pairs must not take `unknown` for a contact.
FirstContact answer(const PairQuery& query);
/// Likewise, but for `unknown` at the limit.
FirstContact answer_or_unknown(const PairQuery& query);
/// The answer `unknown` of a motion that is proven clear until this time.
FirstContact unanswered(const motion::AnyTrajectory& trajectory, double clear_until);
/// The answer, for options that have been checked: at the limit of the thread the bracket so far.
LeastDistance answer(const LeastPairQuery& query);
/// Likewise: at the limit with what is proven so far.
DistanceProfile answer(const PairProfileQuery& query);

} // namespace chasles::query
