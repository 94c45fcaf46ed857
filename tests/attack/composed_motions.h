// Random joints, paths, splines, tracks, and motions made of them, for the families of trajectories.
#pragma once

#include "tests/attack/trajectory_families.h"

namespace chasles::attack {

/// A turn about a line by a polynomial angle: tiny, up to a half turn, or up to several revolutions.
MotionCase hinge_case(AttackRandom& random, bool is_simple, double unit);
/// A polynomial path, half of the time carrying a hinge.
MotionCase polynomial_case(AttackRandom& random, bool is_simple, double unit);
/// A B-spline of 3 to 5 poses.
MotionCase b_spline_case(AttackRandom& random, bool is_simple, double unit);
/// 3 to 6 poses with time stamps; some stamps are next to each other.
MotionCase track_case(AttackRandom& random, bool is_simple, double unit);
/// One motion carries another one.
MotionCase product_case(AttackRandom& random, bool is_simple, double unit);
/// Three to five hinges with fixed poses between them, like an arm.
MotionCase chain_case(AttackRandom& random, bool is_simple, double unit);
/// Both bodies move in the world.
MotionCase both_case(AttackRandom& random, bool is_simple, double unit);

} // namespace chasles::attack
