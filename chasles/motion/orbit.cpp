#include "chasles/motion/orbit.h"

#include <algorithm>
#include <cmath>

namespace chasles::motion {

namespace {

constexpr double least_turn = 0x1p-10;

/// Any unit vector at right angles to a unit vector.
Vector3<double> some_across(const Vector3<double>& along) {
    const int shortest = std::abs(along.x) <= std::abs(along.y) ? (std::abs(along.x) <= std::abs(along.z) ? 0 : 2)
                                                                : (std::abs(along.y) <= std::abs(along.z) ? 1 : 2);
    Vector3<double> unit{};
    unit[shortest] = 1;
    const Vector3<double> across = cross(along, unit);
    return scale(across, 1 / length(across));
}

/// A bound of |tau - phi / turn|: d phi / d tau = 2 |a| / |q|^2, and both are equal at both ends.
double unevenness(double end_cosine, double tangent, double turn) {
    const double bend = end_cosine - 1;
    const double square = bend * bend + tangent * tangent;
    const auto weight = [&](double tau) { return 1 + tau * (2 * bend + tau * square); };
    const double least = weight(std::clamp(-bend / square, 0.0, 1.0));
    const double most = std::max(1.0, weight(1));
    return std::max(2 * tangent / (turn * least) - 1, 1 - 2 * tangent / (turn * most)) / 2;
}

/// The frame as a body sees it that is placed so.
AxisFrame seen_from(const MatrixPose& place, const AxisFrame& frame) {
    const Matrix3<double> back = place.rotation.transposed();
    return {back * (frame.origin - place.translation), back * frame.across, back * frame.beside, back * frame.along};
}

} // namespace

std::optional<Orbit> orbit_of(const RationalMotion<algebra::DoubleDouble>& motion, double most_deviation) {
    const RationalMotion<double> m = rounded(motion);
    const double square = dot(m.axis, m.axis);
    const double tangent = std::sqrt(square);
    const double turn = 2 * std::atan2(tangent, m.end_cosine);
    if (!(turn >= least_turn))
        return std::nullopt;
    const Vector3<double> along = scale(m.axis, 1 / tangent);
    const double slide = dot(m.displacement, along);
    Orbit orbit;
    orbit.unevenness = unevenness(m.end_cosine, tangent, turn);
    orbit.deviation = length(m.displacement - scale(along, slide)) + orbit.unevenness * std::abs(slide);
    if (!(orbit.deviation <= most_deviation))
        return std::nullopt;
    const Vector3<double> across = some_across(along);
    orbit.fixed = {m.origin + scale(cross(m.axis, m.moment), 1 / square), across, cross(along, across), along};
    orbit.moving = seen_from({m.orientation, m.origin}, orbit.fixed);
    orbit.pitch = slide / turn;
    orbit.turn = turn;
    return orbit;
}

MatrixPose start_of(const Orbit& orbit) {
    const auto columns = [](const AxisFrame& frame) {
        return Matrix3<double>{{frame.across, frame.beside, frame.along}}.transposed();
    };
    const Matrix3<double> rotation = columns(orbit.fixed) * columns(orbit.moving).transposed();
    return {rotation, orbit.fixed.origin - rotation * orbit.moving.origin};
}

} // namespace chasles::motion
