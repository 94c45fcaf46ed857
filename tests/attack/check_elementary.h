// Elementary detections in double, in double-double and in exact arithmetic against the exact reference.
#pragma once

#include "tests/attack/elementary_families.h"
#include "tests/attack/tally.h"

#include <string>

namespace chasles::attack {

/// One tally for each precision: what the stages of a query answer. The filter and the refinement are asked everything,
/// the exact stage what these leave open and a share of the rest.
struct StageTallies {
    Tally filter;
    Tally refinement;
    Tally exact;

    StageTallies& operator+=(const StageTallies& other);
};

/// Counts the questions; returns what is wrong with the answers, empty if nothing is. An uncertain contact where there
/// is none is no false alarm of the first two stages: it says that the next one has to look.
std::string check(const QuestionGroup& group, StageTallies& tallies);

} // namespace chasles::attack
