// A first contact on any motion: the library's answer against bisection over time in multiprecision.
#pragma once

#include "tests/attack/tally.h"
#include "tests/attack/trajectory_families.h"

namespace chasles::attack {

/// Counts the case. Returns the error of the answer, or an empty text. A graze that the reference cannot decide is
/// `near`: then the answer is only wrong where a proof of the reference contradicts it.
std::string check(const TrajectoryCase& posed, Tally& tally);

/// The case with every number in hexadecimal.
std::string described(const TrajectoryCase& posed);

} // namespace chasles::attack
