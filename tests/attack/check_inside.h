// The same question about solid bodies: which one is inside of the other one at the start, by sums of solid angles?
#pragma once

#include "chasles/query/first_contact.h"
#include "tests/attack/tally.h"

#include <string>

namespace chasles::attack {

/// `found` answers a question about bodies that are not solid. Returns what is wrong with the answer about solid ones.
std::string check_inside(const FirstContactQuery& surfaces, const FirstContact& found, Tally& tally);

} // namespace chasles::attack
