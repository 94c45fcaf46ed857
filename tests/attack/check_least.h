// The least distance of one mesh pair: the library's bracket against exact arithmetic.
#pragma once

#include "tests/attack/margin_families.h"
#include "tests/attack/tally.h"

namespace chasles::attack {

/// A case of a margin family, asked for its least distance.
struct LeastCase {
    MarginCase posed;
};

struct LeastFamily {
    const char* name;
    double share; ///< of all cases
    MarginCase (*posed)(AttackRandom& random);

    [[nodiscard]] LeastCase make(AttackRandom& random) const { return {posed(random)}; }
};

std::vector<LeastFamily> least_families();

/// Counts the case. Returns the error of the answer, or an empty text. The surfaces must come within the upper end, and
/// never within the lower end.
std::string check(const LeastCase& posed, Tally& tally);

/// The case with every number in hexadecimal.
std::string described(const LeastCase& posed);

} // namespace chasles::attack
