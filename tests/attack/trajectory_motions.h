// Random motions for the families of trajectories.
#pragma once

#include "tests/attack/trajectory_families.h"

namespace chasles::attack {

/// Motions between random poses. The body has the size `unit`. A turn is none, tiny, ordinary, nearly a half turn or
/// exactly a half turn. A travel is up to 100 units, and the centre is up to 1000 units away. `is_simple` makes few
/// digits: quarter turns and half turns about lattice directions, and short travels.
MotionCase velocity_case(AttackRandom& random, bool is_simple, double unit);
MotionCase twist_case(AttackRandom& random, bool is_simple, double unit);

} // namespace chasles::attack
