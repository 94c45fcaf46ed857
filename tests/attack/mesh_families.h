// Families of mesh pairs, most of them degenerate on purpose.
#pragma once

#include "tests/attack/lattice.h"
#include "tests/attack/shapes.h"

#include <span>
#include <string>

namespace chasles::attack {

/// A question about two bodies.
struct MeshCase {
    Shape moving;
    Shape fixed;
    PosedMotion posed;
};

/// Two shapes posed on the lattice where the bodies are at the motion's tau.
MeshCase placed(const LatticeMotion& motion, const Shape& moving, const Shape& fixed);

struct MeshFamily {
    const char* name;
    double share; ///< of all mesh pairs
    MeshCase (*make)(AttackRandom& random);
};

std::span<const MeshFamily> mesh_families();

} // namespace chasles::attack
