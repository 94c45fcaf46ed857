// Motions with all digits, with tiny turns, and with turns of nearly a half turn.
#pragma once

#include "tests/attack/attack_random.h"
#include "tests/attack/posed_motion.h"

namespace chasles::attack {

/// Screws and sweeps, also of two moving bodies; translations up to `distance`.
PosedMotion any_motion(AttackRandom& random, double distance);

/// Changes the motion to a screw by 1e-16 to 1e-3 radians.
void make_tiny_turn(PosedMotion& posed, AttackRandom& random);

/// Changes the motion to a screw by pi or slightly less.
void turn_around(PosedMotion& posed, AttackRandom& random);

} // namespace chasles::attack
