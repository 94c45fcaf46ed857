// Families of questions about motions that are not rational: each motion in each placement of the bodies.
#pragma once

#include "tests/attack/shapes.h"
#include "tests/attack/true_motion.h"

#include "chasles/query/first_contact.h"

#include <string>

namespace chasles::attack {

/// A motion of the library, its truth as seen from the fixed body, and its text.
struct MotionCase {
    Motion motion;
    TrueMotion truth;
    std::string text;
};

/// A query about two bodies.
struct TrajectoryCase {
    Shape moving;
    Shape fixed;
    MotionCase motion;
    Find find = Find::first;
    double time = 0; ///< of a pose to compare
};

/// Where the fixed body is.
enum class Placement : std::uint8_t { near_path, met, grazed, at_start, at_end, lattice };

struct TrajectoryFamily {
    std::string name;
    double share; ///< of all cases
    MotionCase (*motion)(AttackRandom& random, bool is_simple, double unit);
    Placement placement;
    bool has_slivers = false; ///< one of the bodies has faces that are far narrower than long

    [[nodiscard]] TrajectoryCase make(AttackRandom& random) const;
};

/// A new motion is one more line in the list of motions in trajectory_families.cpp.
std::vector<TrajectoryFamily> trajectory_families();

} // namespace chasles::attack
