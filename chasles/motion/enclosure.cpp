// Bounds the distance between a trajectory and the sweep with the same ends, by its speeds and its accelerations.
// Source: docs/derivations/24-enclosures.md.
#include "chasles/motion/enclosure.h"

#include "chasles/motion/screw_path.h"

#include <algorithm>
#include <cmath>

namespace chasles::motion {

namespace {

/// The allowance for the rounding of bounds.
constexpr double outward = 1 + 1e-12;

/// How far a point that moves with at most these rates is from the straight, even way between its ends.
double deviation_from_straight(double speed, double acceleration, double duration) {
    return std::min(0.5 * speed, 0.125 * acceleration * duration) * duration;
}

/// How far, in radians, a body that turns with at most these rates is from the normalised linear interpolation between
/// its ends.
double deviation_from_even_turn(double rate, double acceleration, double duration) {
    const double turn = rate * duration;
    const double by_speed = 0.25 * turn;
    const double by_acceleration = acceleration * duration * duration / 16 + turn * turn * turn / 384;
    const double sine = std::min(by_speed, by_acceleration) / std::cos(std::min(0.25 * turn, 1.0));
    return 2 * sine * (1 + 0.25 * sine * sine); // at least twice the arc sine, for sines up to 1/2
}

double distance_to(const Ball& ball, const Vector3<double>& reference) {
    return length(vector_in<double>(ball.centre) - reference) + ball.radius;
}

} // namespace

double Enclosure::deviation_of(const Ball& ball) const {
    return deviation + turn_deviation * distance_to(ball, reference);
}

double Enclosure::rounding_of(const Ball& ball) const {
    return rounding + turn_rounding * distance_to(ball, reference);
}

double Enclosure::travel_of(const Ball& ball) const {
    return travel + turn * distance_to(ball, reference);
}

Enclosure enclosure_between(const PartEnds& ends, const Vector3<double>& reference, const RateBounds& bounds,
                            double size) {
    Quaternion<double> turn = turn_between(ends.start, ends.goal);
    const double inverse = 1 / std::sqrt(turn.squared_norm());
    turn = {turn.w * inverse, scale(turn.v, inverse)};
    Enclosure result;
    result.cubic = sweep_between(ends.start, ends.goal, turn, reference);
    result.reference = reference;
    result.turn = bounds.turn_rate * ends.duration;
    result.travel = bounds.speed * ends.duration;
    // Both ends of the part have the rounding of poses, and the sweep is computed in double.
    result.turn_rounding = 8 * pose_rounding;
    result.rounding = 2 * pose_rounding * size;
    result.turn_deviation =
        outward * deviation_from_even_turn(bounds.turn_rate, bounds.turn_acceleration, ends.duration) +
        result.turn_rounding;
    result.deviation = outward * deviation_from_straight(bounds.speed, bounds.acceleration, ends.duration) +
                       result.rounding;
    return result;
}

} // namespace chasles::motion
