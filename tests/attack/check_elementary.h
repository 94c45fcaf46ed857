// Elementary detections in double, in double-double and in exact arithmetic against the exact reference.
#pragma once

#include "tests/attack/elementary_families.h"
#include "tests/attack/tally.h"

#include <string>

namespace chasles::attack {

/// One tally for each precision. The filter and the refinement run for all questions. The exact stage runs for the
/// uncertain questions and for a share of the others.
struct StageTallies {
    Tally filter;
    Tally refinement;
    Tally exact;

    StageTallies& operator+=(const StageTallies& other);
};

/// Counts the questions. Returns a description of wrong answers, or an empty text. In the first two stages an uncertain
/// contact without a real contact is not a false alarm, because the next stage decides it.
std::string check(const QuestionGroup& group, StageTallies& tallies);

} // namespace chasles::attack
