// One question about one pair of bodies, piece by piece of the motion.
#pragma once

#include "chasles/mesh/body.h"
#include "chasles/motion/any_trajectory.h"
#include "chasles/query/first_contact.h"
#include "chasles/query/least_distance.h"

#include <span>
#include <string>

namespace chasles::search {
class NeighbourList;
class OrbitFilter;
} // namespace chasles::search

namespace chasles::query {

/// A question by reference: batches answer many of them without copying bodies.
struct PairQuery {
    const Body& moving;
    const Body& fixed;
    const motion::AnyTrajectory& trajectory;
    const QueryOptions& options;
    double until = 1;                            ///< time in [0, 1]: contacts that begin later need not be found
    search::NeighbourList* neighbours = nullptr; ///< of both bodies: saves time where questions follow each other
    search::OrbitFilter* orbits = nullptr;       ///< likewise, where they turn about one axis
};

/// Likewise for the least distance.
struct LeastPairQuery {
    const Body& moving;
    const Body& fixed;
    const motion::AnyTrajectory& trajectory;
    const LeastDistanceOptions& options;
};

/// Throws InvalidInput "query: OPTION: WHY" unless it holds.
void require(bool holds, const char* option, const char* why);

/// Throws InvalidInput for a distance to hold that is none, whatever the margin.
void require_hold(double hold);

/// Throws InvalidInput for an option out of its range.
void check_options(const QueryOptions& options);
void check_options(const LeastDistanceOptions& options);

/// Why the motion is refused for these bodies; empty if it is not. An enclosed motion must not go farther than 1e10
/// times the radius of the larger body (docs/decisions/0012-range-of-coordinates.md).
std::string refusal_of(const Body& moving, const Body& fixed, const motion::AnyTrajectory& trajectory);
/// Throws InvalidInput "motion: WHY" if it is refused.
void require_near(const Body& moving, const Body& fixed, const motion::AnyTrajectory& trajectory);
/// Throws InvalidInput "motions[I]: WHY" for the first one that is refused.
void require_near(const Body& moving, const Body& fixed, std::span<const Motion> motions);

/// The answer, for options that have been checked. Throws InvalidInput for a motion that is refused, and Cancelled at
/// the limit of the thread: what asks about many pairs must not take `unknown` for a contact.
FirstContact answer(const PairQuery& query);
/// Likewise, but for `unknown` at the limit.
FirstContact answer_or_unknown(const PairQuery& query);
/// The answer, for options that have been checked: at the limit of the thread the bracket so far.
LeastDistance answer(const LeastPairQuery& query);

} // namespace chasles::query
