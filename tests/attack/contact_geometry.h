// Are the contacts of an answer where they say: points on their features, as far apart as they say, along the normal?
#pragma once

#include "chasles/query/first_contact.h"

#include <string>

namespace chasles::attack {

/// What is wrong with a contact of the answer, empty if nothing is. In doubles, at time.lower.
std::string misplaced(const FirstContactQuery& query, const FirstContact& found, double scene_size);

} // namespace chasles::attack
