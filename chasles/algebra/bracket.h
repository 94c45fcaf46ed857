// A closed interval of doubles that encloses one real number. It is part of the public answers.
#pragma once

namespace chasles {

/// lower <= the number <= upper.
struct Bracket {
    double lower = 0;
    double upper = 0;
};

} // namespace chasles
