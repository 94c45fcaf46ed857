// Why contact could not be told from a miss, as a sentence without a full stop.
#pragma once

#include "chasles/chasles.h"

#include <string>

namespace chasles::view {

/// For an answer that is not certain. The reason is what the answer itself shows, with the least gap of its contacts.
/// Times are shares of the motion, in [0, 1]: ask before they become stamps. `ends_there` is false if another motion
/// follows.
std::string why_uncertain(const FirstContact& found, bool ends_there = true);

} // namespace chasles::view
