// Motions with all their digits, and motions that hardly turn or turn almost around.
#pragma once

#include "tests/attack/attack_random.h"
#include "tests/attack/posed_motion.h"

namespace chasles::attack {

/// Screws and sweeps, also of two moving bodies; translations up to `distance`.
PosedMotion any_motion(AttackRandom& random, double distance);

/// Makes it a screw by 1e-16 to 1e-3 radians.
void turn_hardly(PosedMotion& posed, AttackRandom& random);

/// Makes it a screw by pi or a little less.
void turn_around(PosedMotion& posed, AttackRandom& random);

} // namespace chasles::attack
