// Families of mesh pairs with a margin, most of them degenerate on purpose.
#pragma once

#include "tests/attack/mesh_families.h"

namespace chasles::attack {

/// A query about two bodies: the first time at which their distance is the margin.
struct MarginCase {
    MeshCase mesh;
    double margin = 0;
};

struct MarginFamily {
    const char* name;
    double share; ///< of all cases
    MarginCase (*make)(AttackRandom& random);
};

std::span<const MarginFamily> margin_families();

} // namespace chasles::attack
