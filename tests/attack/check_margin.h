// One mesh pair with a margin: the library's answer against the exact one.
#pragma once

#include "tests/attack/margin_families.h"
#include "tests/attack/tally.h"

namespace chasles::attack {

/// Counts the case. Returns the error of the answer, or an empty text. Certain answers must be exactly right. Other
/// answers must be right within the resolution of distances (docs/promises.md).
std::string check(const MarginCase& posed, Tally& tally);

/// The case with every number in hexadecimal.
std::string described(const MarginCase& posed);

} // namespace chasles::attack
