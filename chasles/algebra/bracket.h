// A closed interval that encloses a number.
#pragma once

namespace chasles {

/// lower <= the number <= upper.
struct Bracket {
    double lower = 0;
    double upper = 0;
};

} // namespace chasles
