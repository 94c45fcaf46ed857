// Checks the contacts of an answer: points on their features, the right gap, and the right normal.
#pragma once

#include "chasles/query/first_contact.h"

#include <string>

namespace chasles::attack {

/// The error of a contact of the answer at time.lower, or an empty text. Computed in doubles.
std::string misplaced(const FirstContactQuery& query, const FirstContact& found, double scene_size);

} // namespace chasles::attack
