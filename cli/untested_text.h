// What an answer does not look at, for people. A verdict never claims more than was tested.
#pragma once

#include "chasles/chasles.h"

#include <string>

namespace chasles::cli {

/// The verdict of an answer without contact, without the end of the line: of all pairs, or of those that are tested.
/// What happens after `until` was not asked.
std::string clear_headline(const UntestedPairs& untested, const QueryOptions& options, double until = 1);

/// The line below the verdict: how many pairs are not tested, which, and why. Empty if all are.
std::string report(const UntestedPairs& untested);

/// The line below it where bodies at rest are all there is to test: how to test them. Empty elsewhere.
std::string way_to_test_rest(const UntestedPairs& untested, const char* way);

} // namespace chasles::cli
