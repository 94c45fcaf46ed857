// Why contact could not be told from a miss, as a sentence without a full stop.
#pragma once

#include "chasles/chasles.h"

#include <string>

namespace chasles::view {

/// For an answer that is not certain. The reason is what the answer itself shows.
std::string why_uncertain(const FirstContact& found);

} // namespace chasles::view
