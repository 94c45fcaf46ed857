// Bounds the distance between a trajectory and the sweep with the same ends, by its speeds and its accelerations.
// Source: docs/derivations/24-enclosures.md.
#include "chasles/motion/enclosure.h"

#include "chasles/algebra/sine_cosine.h"
#include "chasles/motion/screw_path.h"

#include <algorithm>
#include <cmath>

namespace chasles::motion {

namespace {

/// The allowance for the rounding of bounds.
constexpr double outward = 1 + 1e-12;

/// How far, in radians, a body that turns with at most these rates is from the normalised linear interpolation between
/// its ends.
double deviation_from_even_turn(double rate, double acceleration, double duration) {
    const double turn = rate * duration;
    const double by_speed = 0.25 * turn;
    const double by_acceleration = acceleration * duration * duration / 16 + turn * turn * turn / 384;
    const double sine = std::min(by_speed, by_acceleration) / algebra::cosine(std::min(0.25 * turn, 1.0));
    return 2 * sine * (1 + 0.25 * sine * sine); // at least twice the arc sine, for sines up to 1/2
}

double distance_to(const Ball& ball, const Vector3<double>& reference) {
    return length(vector_in<double>(ball.centre) - reference) + ball.radius;
}

} // namespace

double deviation_from_straight(const RateBounds& rates, double distance, double duration) {
    return std::min(0.5 * rates.speed_at(distance), 0.125 * rates.acceleration_at(distance) * duration) * duration;
}

double EnclosureBounds::deviation_of(const Ball& ball) const {
    return deviation + turn_deviation * distance_to(ball, reference);
}

double EnclosureBounds::rounding_of(const Ball& ball) const {
    return rounding + turn_rounding * distance_to(ball, reference);
}

/// The frame of the moving body sees a displacement along an axis that turns a little.
double EnclosureBounds::deviation_along_axis(const Ball& ball) const {
    const double all = deviation_of(ball);
    return std::min(all, along.deviation + along.turn_deviation * distance_to(ball, reference) + along.turn * all);
}

double EnclosureBounds::travel_of(const Ball& ball) const {
    return travel + turn * distance_to(ball, reference);
}

EnclosureBounds enclosure_bounds(const Vector3<double>& reference, const RateBounds& rates, double duration,
                                 double rounding, double size) {
    EnclosureBounds bounds;
    bounds.reference = reference;
    bounds.turn = rates.turn_rate * duration;
    bounds.travel = rates.speed * duration;
    // Both ends of the part have the rounding of poses, and the sweep is computed with as much.
    bounds.turn_rounding = 8 * rounding;
    bounds.rounding = 2 * rounding * size;
    bounds.turn_deviation =
        outward * deviation_from_even_turn(rates.turn_rate, rates.turn_acceleration, duration) + bounds.turn_rounding;
    bounds.deviation = outward * deviation_from_straight(rates, 0, duration) + bounds.rounding;
    return bounds;
}

AxisBounds bounds_along(const Vector3<algebra::DoubleDouble>& axis, const AxisRates& across, double turn_rate,
                        double duration, const EnclosureBounds& part, double rounding) {
    const double eighth = 0.125 * duration * duration;
    const double bend = across.turn_acceleration + (3 * turn_rate + across.turn) * across.turn;
    return {axis, outward * eighth * across.acceleration + part.rounding, outward * eighth * bend + part.turn_rounding,
            outward * 2 * across.turn * duration + part.turn_rounding + rounding};
}

} // namespace chasles::motion
