// What an answer does not look at, for people. A verdict never claims more than was tested.
#pragma once

#include "chasles/chasles.h"

#include <string>
#include <string_view>

namespace chasles::cli {

/// The verdict of an answer without contact, without the end of the line: of all pairs, or of those that are tested.
/// What happens after `until` was not asked.
std::string clear_headline(const UntestedPairs& untested, const QueryOptions& options, double until = 1);

/// The line below the verdict: how many pairs are not tested, which, and why. Empty if all are.
std::string report(const UntestedPairs& untested);

/// The same for a scene. Where bodies at rest are all there is to test, it says how to test them: without the option,
/// if one is named.
std::string report_of_scene(const UntestedPairs& untested, std::string_view option = {});

} // namespace chasles::cli
