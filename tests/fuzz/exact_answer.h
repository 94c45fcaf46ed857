// The true answer of a query. Only this header gives access to the exact reference.
#pragma once

#include "tests/fuzz/question.h"

namespace chasles::fuzz {

/// The first contact of the surfaces in a whole motion, which may consist of pieces.
struct ExactAnswer {
    bool touches = false;
    bool at_start = false;
    bool moving_is_inside = false; ///< at the start, where surfaces do not meet
    bool fixed_is_inside = false;
    double tau_lower = 0; ///< with `tau_upper`: bracket of the first contact's tau, as FirstContact::tau
    double tau_upper = 0;
    double time_lower = 0; ///< the same in time
    double time_upper = 0;
};

/// The answer is exact for the pieces of a cut screw, whose end poses are in double precision.
ExactAnswer exact_answer(const Question& question);

} // namespace chasles::fuzz
