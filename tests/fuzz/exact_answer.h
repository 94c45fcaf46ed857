// What is true of a question. The exact reference stands behind this header and nowhere else.
#pragma once

#include "tests/fuzz/question.h"

namespace chasles::fuzz {

/// The first contact of a whole motion, which may consist of pieces.
struct ExactAnswer {
    bool touches = false;
    bool at_start = false;
    double tau_lower = 0; ///< with `tau_upper` around tau of the first contact, counted as in FirstContact::tau
    double tau_upper = 0;
    double time_lower = 0; ///< the same in time
    double time_upper = 0;
};

/// Exact for the pieces of a screw themselves, whose ends are poses in double precision.
ExactAnswer exact_answer(const Question& question);

} // namespace chasles::fuzz
