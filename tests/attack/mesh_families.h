// Families of mesh pairs, most of them degenerate on purpose.
#pragma once

#include "tests/attack/lattice.h"
#include "tests/attack/shapes.h"

#include <span>
#include <string>

namespace chasles::attack {

/// A query about two bodies.
struct MeshCase {
    Shape moving;
    Shape fixed;
    PosedMotion posed;
};

/// A case with two shapes that are on the lattice at the motion's tau.
MeshCase placed(const LatticeMotion& motion, const Shape& moving, const Shape& fixed);

struct MeshFamily {
    const char* name;
    double share; ///< share of all mesh pairs
    MeshCase (*make)(AttackRandom& random);
};

std::span<const MeshFamily> mesh_families();

} // namespace chasles::attack
