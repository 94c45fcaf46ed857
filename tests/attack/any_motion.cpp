#include "tests/attack/any_motion.h"

namespace chasles::attack {

namespace {

Pose any_pose(AttackRandom& random, double distance) {
    const Eigen::Vector3d v = random.vector(1);
    return Pose(random.vector(distance), Eigen::Quaterniond(random.uniform(-1, 1), v.x(), v.y(), v.z()));
}

/// The square of a quaternion with 24 bits has a rational length.
Pose sweepable_pose(AttackRandom& random, double distance) {
    const auto number = [&] { return double(random.integer(-(1 << 23), 1 << 23)); };
    const Eigen::Quaterniond q(number(), number(), number(), number());
    return Pose(random.vector(distance), Eigen::Quaterniond(q * q));
}

} // namespace

PosedMotion any_motion(AttackRandom& random, double distance) {
    PosedMotion posed;
    posed.kind = random.chance(0.6) ? MotionKind::screw : MotionKind::sweep;
    posed.is_relative = random.chance(0.3);
    for (Pose* pose : {&posed.moving_start, &posed.moving_goal, &posed.fixed_start, &posed.fixed_goal})
        *pose = posed.kind == MotionKind::screw ? any_pose(random, distance) : sweepable_pose(random, distance);
    if (posed.is_relative) // the bodies move mostly together, so that they touch
        posed.fixed_start.translation *= 0.3;
    else
        posed.fixed_start = posed.fixed_goal = Pose();
    return posed;
}

void make_tiny_turn(PosedMotion& posed, AttackRandom& random) {
    const double size = std::ldexp(1.0, -random.integer(10, 56));
    const Eigen::Vector3d v = random.grid_direction(3).cast<double>();
    const double half = random.chance(0.5) ? size : size * random.uniform(0.5, 1);
    posed.kind = MotionKind::screw; // the length of such a turn is not rational
    const Eigen::Quaterniond turn(1, half * v.x(), half * v.y(), half * v.z());
    posed.moving_goal.rotation = turn * Eigen::Quaterniond(posed.moving_start.rotation);
    posed.fixed_goal.rotation = posed.fixed_start.rotation;
}

void turn_around(PosedMotion& posed, AttackRandom& random) {
    posed.kind = MotionKind::screw;
    posed.is_relative = false;
    posed.fixed_start = posed.fixed_goal = Pose();
    const Eigen::Vector3d v = random.grid_direction(3).cast<double>();
    const double cosine = random.chance(0.6) ? std::ldexp(1.0, -random.integer(3, 9)) : random.uniform(0, 0.3);
    const double end = random.chance(0.1) ? 0 : cosine;
    posed.moving_goal.rotation =
        Eigen::Quaterniond(end, v.x(), v.y(), v.z()) * Eigen::Quaterniond(posed.moving_start.rotation);
}

} // namespace chasles::attack
