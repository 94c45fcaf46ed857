// A screw turns in proportion to time and slides in proportion to tau. A sweep turns by the normalised interpolation of
// quaternions (docs/derivations/02-rational-motion.md). The other motions are even in time.
#include "view/motion_numbers.h"

#include <algorithm>
#include <cmath>

namespace chasles::view {
namespace {

double turned_by_sweep(double angle, double tau) {
    return 2 * std::atan2(tau * std::sin(angle / 2), 1 + tau * (std::cos(angle / 2) - 1));
}

// Brackets of time stamps are rounded outward, so that a time may lie before the start by a rounding error.
double share_of(const Bracket& span, double time) {
    return std::clamp((time - span.lower) / (span.upper - span.lower), 0.0, 1.0);
}

MotionNumbers numbers_with(const ScrewMotion& screw_of_same_poses, MotionKind kind) {
    MotionNumbers numbers = numbers_of(screw_of_same_poses);
    numbers.kind = kind;
    return numbers;
}

} // namespace

MotionNumbers numbers_of(const ScrewMotion& screw) {
    return {.angle = screw.angle(),
            .slide = screw.slide(),
            .axis_point = screw.axis_point(),
            .axis_direction = screw.axis_direction()};
}

MotionNumbers numbers_of(const SweepMotion& sweep) {
    MotionNumbers numbers = numbers_with(sweep.screw_of_same_poses(), MotionKind::sweep);
    numbers.displacement = sweep.displacement();
    return numbers;
}

MotionNumbers numbers_of(const ConstantVelocity& velocity) {
    MotionNumbers numbers =
        numbers_with(ScrewMotion::between(velocity.pose_at(0), velocity.pose_at(1)), MotionKind::velocity);
    numbers.displacement = velocity.displacement();
    return numbers;
}

MotionNumbers numbers_of(const ConstantTwist& twist) {
    return numbers_with(twist.screw_of_same_poses(), MotionKind::twist);
}

bool moves_straight(MotionKind kind) {
    return kind == MotionKind::sweep || kind == MotionKind::velocity;
}

bool has_tau(MotionKind kind) {
    return kind == MotionKind::screw || kind == MotionKind::sweep;
}

Progress progress_at(const MotionNumbers& motion, double time, double tau) {
    const double share = share_of(motion.span, time);
    const double length = moves_straight(motion.kind) ? motion.displacement.norm() : motion.slide;
    return {.turned = motion.kind == MotionKind::sweep ? turned_by_sweep(motion.angle, tau) : motion.angle * share,
            .length = length * (has_tau(motion.kind) ? tau : share)};
}

} // namespace chasles::view
