// One mesh pair with a margin: the library's answer against the exact one.
#pragma once

#include "tests/attack/margin_families.h"
#include "tests/attack/tally.h"

namespace chasles::attack {

/// Counts the case; returns what is wrong with the answer, empty if nothing is. Answers that are certain must be right
/// to the last bit; others by so much of the scene's size as distances can be told apart (docs/promises.md).
std::string check(const MarginCase& posed, Tally& tally);

/// The case with every number in hexadecimal.
std::string described(const MarginCase& posed);

} // namespace chasles::attack
