// Composes rates, and bounds them by their Taylor expansions.
// Source: docs/derivations/26-frames.md, "Sharper bounds".
#include "chasles/motion/rate_expansion.h"

#include <algorithm>
#include <cmath>

namespace chasles::motion {

namespace {

using algebra::Matrix3;

/// The allowance for the rounding of vectors, over the sums that they are.
constexpr double sum_rounding = 1e-12;

/// The product of two bounds, of which one may be infinite while the other is zero.
double bound_product(double a, double b) {
    return a > 0 && b > 0 ? a * b : 0;
}

/// Bounds of how fast the components of a turning vector change: the matrix R of the turn has rates R' = [w] R,
/// R'' = ([w'] + [w]^2) R and R''' = ([w''] + 2 [w'] [w] + [w] [w'] + [w]^3) R.
struct TurningRates {
    double first, second, third;

    TurningRates(const RateBounds& bounds, double turn_jerk)
        : first(bounds.turn_rate), second(bounds.turn_acceleration + first * first),
          third(turn_jerk + 3 * bound_product(bounds.turn_acceleration, first) + first * first * first) {}
};

/// Takes the bounds that follow from the middle where they are smaller.
void sharpen(RateExpansion& e, double half) {
    half = half * (1 + sum_rounding) + 0x1p-50; // the middle is rounded
    const auto bound = [&](const Vector3<double>& middle, double change, double sum) {
        return length(middle) * (1 + sum_rounding) + sum_rounding * sum + bound_product(half, change);
    };
    RateBounds& bounds = e.bounds;
    const RateBounds& sums = e.sums;
    bounds.turn_acceleration =
        std::min(bounds.turn_acceleration, bound(e.turn_acceleration, e.turn_jerk, sums.turn_acceleration));
    bounds.acceleration = std::min(bounds.acceleration, bound(e.acceleration, e.jerk, sums.acceleration));
    if (!std::isfinite(e.turn_jerk + e.jerk))
        return; // the vectors may be unknown
    bounds.turn_rate = std::min(bounds.turn_rate, bound(e.turn_rate, bounds.turn_acceleration, sums.turn_rate));
    bounds.speed = std::min(bounds.speed, bound(e.velocity, bounds.acceleration, sums.speed));
}

RateBounds carried(const RateBounds& outer, const RateBounds& inner, double arm) {
    return {outer.turn_rate + inner.turn_rate,
            outer.turn_acceleration + inner.turn_acceleration + outer.turn_rate * inner.turn_rate,
            outer.speed + outer.turn_rate * arm + inner.speed,
            outer.acceleration + bound_product(outer.turn_acceleration + outer.turn_rate * outer.turn_rate, arm) +
                2 * outer.turn_rate * inner.speed + inner.acceleration};
}

RateBounds seen_from(const RateBounds& moving, const RateBounds& fixed, double arm) {
    const double speed = moving.speed + fixed.speed;
    return {moving.turn_rate + fixed.turn_rate,
            moving.turn_acceleration + fixed.turn_acceleration + moving.turn_rate * fixed.turn_rate,
            speed + fixed.turn_rate * arm,
            moving.acceleration + fixed.acceleration +
                bound_product(fixed.turn_acceleration + fixed.turn_rate * fixed.turn_rate, arm) +
                2 * fixed.turn_rate * speed};
}

} // namespace

double distance_of_references(const RateExpansion& a, const RateExpansion& b, double size, double change) {
    return length(a.reference - b.reference) * (1 + sum_rounding) + sum_rounding * size + change;
}

RateExpansion carried(const RateExpansion& outer, const RateExpansion& inner, double half, double size) {
    const Matrix3<double> turn = scaled_rotation_matrix(outer.pose.rotation);
    const auto placed = [&](const Vector3<double>& point) { return turn * point + outer.pose.translation; };
    RateExpansion e{.pose = {placed(inner.pose.translation), outer.pose.rotation * inner.pose.rotation},
                    .reference = placed(inner.reference)};
    const Vector3<double>& w = outer.turn_rate;
    const Vector3<double> arm = e.reference - outer.reference;
    e.turn_rate = w;
    e.turn_acceleration = outer.turn_acceleration;
    e.velocity = outer.velocity + cross(w, arm);
    e.acceleration = outer.acceleration + cross(outer.turn_acceleration, arm) + cross(w, cross(w, arm));
    if (inner.bounds.turn_rate > 0) {
        const Vector3<double> turn_rate = turn * inner.turn_rate;
        e.turn_rate = e.turn_rate + turn_rate;
        e.turn_acceleration = e.turn_acceleration + turn * inner.turn_acceleration + cross(w, turn_rate);
    }
    if (inner.bounds.speed > 0) {
        const Vector3<double> velocity = turn * inner.velocity;
        e.velocity = e.velocity + velocity;
        e.acceleration = e.acceleration + turn * inner.acceleration + scale(cross(w, velocity), 2.0);
    }

    const double arm_bound = distance_of_references(e, outer, size, half * inner.bounds.speed);
    e.sums = carried(outer.sums, inner.sums, arm_bound);
    e.bounds = carried(outer.bounds, inner.bounds, arm_bound);
    const TurningRates rates(outer.bounds, outer.turn_jerk);
    e.turn_jerk = outer.turn_jerk + inner.turn_jerk + 2 * bound_product(rates.first, inner.bounds.turn_acceleration) +
                  bound_product(rates.second, inner.bounds.turn_rate);
    e.jerk = outer.jerk + bound_product(rates.third, arm_bound) + 3 * bound_product(rates.second, inner.bounds.speed) +
             3 * bound_product(rates.first, inner.bounds.acceleration) + inner.jerk;
    sharpen(e, half);
    return e;
}

RateExpansion seen_from(const RateExpansion& moving, const RateExpansion& fixed, double half, double size) {
    const Quaternion<double> turn_back = fixed.pose.rotation.conjugate();
    const Matrix3<double> back = scaled_rotation_matrix(turn_back);
    const auto seen = [&](const Vector3<double>& point) { return back * (point - fixed.pose.translation); };
    RateExpansion e{.pose = {seen(moving.pose.translation), turn_back * moving.pose.rotation},
                    .reference = seen(moving.reference)};
    const Vector3<double> arm = moving.reference - fixed.reference;
    const Vector3<double> velocity = moving.velocity - fixed.velocity;
    const Vector3<double>& w = fixed.turn_rate;
    e.turn_rate = back * (moving.turn_rate - w);
    e.turn_acceleration = back * (moving.turn_acceleration - fixed.turn_acceleration - cross(w, moving.turn_rate));
    e.velocity = back * (velocity - cross(w, arm));
    e.acceleration = back * (moving.acceleration - fixed.acceleration - cross(fixed.turn_acceleration, arm) -
                             cross(w, scale(velocity, 2.0) - cross(w, arm)));

    const double speed = moving.bounds.speed + fixed.bounds.speed;
    const double arm_bound = distance_of_references(moving, fixed, size, half * speed);
    e.sums = seen_from(moving.sums, fixed.sums, arm_bound);
    e.bounds = seen_from(moving.bounds, fixed.bounds, arm_bound);
    const TurningRates rates(fixed.bounds, fixed.turn_jerk);
    e.turn_jerk = moving.turn_jerk + fixed.turn_jerk + 2 * bound_product(rates.first, moving.bounds.turn_acceleration) +
                  bound_product(rates.second, moving.bounds.turn_rate) +
                  bound_product(rates.first, fixed.bounds.turn_acceleration);
    e.jerk = bound_product(rates.third, arm_bound) + 3 * bound_product(rates.second, speed) +
             3 * bound_product(rates.first, moving.bounds.acceleration + fixed.bounds.acceleration) + moving.jerk +
             fixed.jerk;
    sharpen(e, half);
    return e;
}

RateBounds slowed(const RateBounds& bounds, double duration) {
    const double rate = 1 / std::abs(duration);
    return {bounds.turn_rate * rate, bound_product(bounds.turn_acceleration, rate * rate), bounds.speed * rate,
            bound_product(bounds.acceleration, rate * rate)};
}

RateExpansion slowed(RateExpansion e, double duration) {
    const double rate = 1 / duration, square = rate * rate, cube = square * std::abs(rate);
    e.turn_rate = scale(e.turn_rate, rate);
    e.velocity = scale(e.velocity, rate);
    e.turn_acceleration = scale(e.turn_acceleration, square);
    e.acceleration = scale(e.acceleration, square);
    e.bounds = slowed(e.bounds, duration);
    e.sums = slowed(e.sums, duration);
    e.turn_jerk = bound_product(e.turn_jerk, cube);
    e.jerk = bound_product(e.jerk, cube);
    return e;
}

} // namespace chasles::motion
