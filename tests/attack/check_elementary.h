// Elementary detections in double and double-double precision against the exact reference.
#pragma once

#include "tests/attack/elementary_families.h"
#include "tests/attack/tally.h"

#include <string>

namespace chasles::attack {

/// One tally for each precision: what the filter and the refinement of a query answer.
struct StageTallies {
    Tally filter;
    Tally refinement;
};

/// Counts the questions; returns what is wrong with the answers, empty if nothing is. An uncertain contact where there
/// is none is no false alarm of a stage: it says that the next one has to look.
std::string check(const QuestionGroup& group, StageTallies& tallies);

} // namespace chasles::attack
