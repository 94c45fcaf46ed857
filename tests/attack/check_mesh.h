// One mesh pair: the library's answer against the exact one.
#pragma once

#include "tests/attack/mesh_families.h"
#include "tests/attack/tally.h"

namespace chasles::attack {

/// Counts the case. Returns the error of the answer, or an empty text.
std::string check(const MeshCase& posed, Tally& tally);

/// The case with every number in hexadecimal.
std::string described(const MeshCase& posed);
std::string described(const char* name, const Pose& pose);
std::string described(const char* name, const Shape& shape);

} // namespace chasles::attack
