// What a question must satisfy before it is answered.
#pragma once

#include "chasles/mesh/body.h"
#include "chasles/motion/any_trajectory.h"
#include "chasles/query/first_contact.h"
#include "chasles/query/least_distance.h"
#include "chasles/query/profile.h"

#include <span>
#include <string>

namespace chasles::query {

/// Throws InvalidInput "query: OPTION: WHY" unless it holds.
void require(bool holds, const char* option, const char* why);

/// Throws InvalidInput for a distance to hold that is none, whatever the margin.
void require_hold(double hold);

/// Throws InvalidInput for an option out of its range.
void check_options(const QueryOptions& options);
/// Pairs of bodies may have margins of their own: `of_some_pair` is the largest one.
void check_options(const QueryOptions& options, double of_some_pair);
void check_options(const LeastDistanceOptions& options);
void check_options(const ProfileOptions& options);

/// Why the motion is refused for these bodies; empty if it is not. An enclosed motion must not go farther than 1e10
/// times the radius of the larger body (docs/decisions/0012-range-of-coordinates.md).
std::string refusal_of(const Body& moving, const Body& fixed, const motion::AnyTrajectory& trajectory);
/// Throws InvalidInput "motion: WHY" if it is refused.
void require_near(const Body& moving, const Body& fixed, const motion::AnyTrajectory& trajectory);
/// Throws InvalidInput "motions[I]: WHY" for the first one that is refused.
void require_near(const Body& moving, const Body& fixed, std::span<const Motion> motions);

} // namespace chasles::query
