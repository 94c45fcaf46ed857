// The verdict that an answer about the least distance proves.
#pragma once

#include "chasles/query/least_distance.h"

namespace chasles::view {

/// `clear` if the bodies are proven to stay apart, `contact` or `contact_at_start` if they are proven to touch, and
/// `unknown` if neither is proven.
Verdict proven_verdict(const LeastDistance& found);

} // namespace chasles::view
