// Composes the rates across a direction. Source: docs/derivations/36-heights.md, "Frames that are composed".
#include "chasles/motion/axis_rates.h"

#include "chasles/motion/moving_frame.h"

namespace chasles::motion {

namespace {

/// How far a direction that stays up to these rates turns from the middle of the interval.
double turned(const AxisRates& across, double half) {
    return across.turn * half + axis_rounding<double>;
}

/// For a direction that is off by so much.
AxisRates tilted(const AxisRates& across, double tilt, const RateBounds& all) {
    return {across.turn + tilt * all.turn_rate, across.turn_acceleration + tilt * all.turn_acceleration,
            across.acceleration + tilt * all.acceleration};
}

/// Of the product of two angular velocities, across the direction.
double product_across(double turn, const AxisRates& across, double other_turn, const AxisRates& other) {
    return turn * other.turn + other_turn * across.turn + across.turn * other.turn;
}

/// Along the direction, of a point that is at rest in a turning frame, at this distance from its reference.
double acceleration_of_arm(const AxisRates& across, double turn_rate, double arm) {
    return (across.turn_acceleration + across.turn * (turn_rate + across.turn)) * arm;
}

} // namespace

std::optional<AxisExpansion> MovingFrame::expansion_about(const Vector3<double>& /*direction*/,
                                                          const Bracket& /*times*/) const {
    return std::nullopt;
}

Vector3<double> seen_by(const RateExpansion& frame, const Vector3<double>& direction) {
    return scaled_rotation_matrix(frame.pose.rotation).transposed() * direction;
}

std::optional<AxisExpansion> slowed(std::optional<AxisExpansion> expansion, double duration) {
    if (!expansion)
        return expansion;
    const double rate = 1 / std::abs(duration);
    AxisRates& across = expansion->across;
    across = {across.turn * rate, across.turn_acceleration * rate * rate, across.acceleration * rate * rate};
    expansion->all = slowed(std::move(expansion->all), duration);
    return expansion;
}

AxisRates turn_across(const Vector3<double>& axis, const Vector3<double>& direction, double rate, double acceleration,
                      double arm) {
    const double tilt = length(cross(axis, direction)) + axis_rounding<double>;
    return {tilt * rate, tilt * acceleration, tilt * rate * rate * arm};
}

AxisExpansion carried(const AxisExpansion& outer, const AxisExpansion& inner, double half, double size) {
    AxisExpansion e;
    e.all = carried(outer.all, inner.all, half, size);
    const RateBounds &carrying = outer.all.bounds, &own = inner.all.bounds;
    const AxisRates& first = outer.across;
    const AxisRates second = tilted(inner.across, turned(first, half), own);
    const double arm = distance_of_references(e.all, outer.all, size, half * own.speed);
    e.across.turn = first.turn + second.turn;
    e.across.turn_acceleration = first.turn_acceleration + second.turn_acceleration +
                                 product_across(carrying.turn_rate, first, own.turn_rate, second);
    e.across.acceleration = first.acceleration + acceleration_of_arm(first, carrying.turn_rate, arm) +
                            2 * first.turn * own.speed + second.acceleration;
    return e;
}

AxisExpansion seen_from(const AxisExpansion& moving, const AxisExpansion& fixed, double half, double size) {
    AxisExpansion e;
    e.all = seen_from(moving.all, fixed.all, half, size);
    const double tilt = turned(fixed.across, half);
    const RateBounds &seen = moving.all.bounds, &seeing = fixed.all.bounds;
    const AxisRates first = tilted(moving.across, tilt, seen), second = tilted(fixed.across, tilt, seeing);
    const double speed = seen.speed + seeing.speed;
    const double arm = distance_of_references(moving.all, fixed.all, size, half * speed);
    e.across.turn = first.turn + second.turn;
    e.across.turn_acceleration = first.turn_acceleration + second.turn_acceleration +
                                 product_across(seen.turn_rate, first, seeing.turn_rate, second);
    e.across.acceleration = first.acceleration + second.acceleration +
                            acceleration_of_arm(second, seeing.turn_rate, arm) + 2 * second.turn * speed;
    return e;
}

} // namespace chasles::motion
