#include "chasles/motion/orbit.h"

#include "chasles/algebra/arc_tangent.h"
#include "chasles/motion/screw_path.h"

#include <algorithm>
#include <cmath>

namespace chasles::motion {

namespace {

constexpr double least_turn = 0x1p-10;

/// A bound of |tau - phi / turn|: d phi / d tau = 2 |a| / |q|^2, and both are equal at both ends.
double unevenness(double end_cosine, double tangent, double turn) {
    const double bend = end_cosine - 1;
    const double square = bend * bend + tangent * tangent;
    const auto weight = [&](double tau) { return 1 + tau * (2 * bend + tau * square); };
    const double least = weight(std::clamp(-bend / square, 0.0, 1.0));
    const double most = std::max(1.0, weight(1));
    return std::max(2 * tangent / (turn * least) - 1, 1 - 2 * tangent / (turn * most)) / 2;
}

/// The frame in the coordinates of a body that stands at the place.
AxisFrame seen_from(const MatrixPose& place, const AxisFrame& frame) {
    const Matrix3<double> back = place.rotation.transposed();
    return {back * (frame.origin - place.translation), back * frame.across, back * frame.beside, back * frame.along};
}

} // namespace

std::optional<Orbit> orbit_of(const RationalMotion<algebra::DoubleDouble>& motion, double most_deviation) {
    const RationalMotion<double> m = rounded(motion);
    const double square = dot(m.axis, m.axis);
    const double tangent = std::sqrt(square);
    const double turn = 2 * algebra::arc_tangent(tangent, m.end_cosine);
    if (!(turn >= least_turn))
        return std::nullopt;
    const Vector3<double> along = scale(m.axis, 1 / tangent);
    const double slide = dot(m.displacement, along);
    Orbit orbit;
    orbit.unevenness = unevenness(m.end_cosine, tangent, turn);
    orbit.deviation = length(m.displacement - scale(along, slide)) + orbit.unevenness * std::abs(slide);
    if (!(orbit.deviation <= most_deviation))
        return std::nullopt;
    const Vector3<double> across = vector_in<double>(Eigen::Vector3d(along.x, along.y, along.z).unitOrthogonal());
    orbit.start = {m.orientation, m.origin};
    orbit.fixed = {m.origin + scale(cross(m.axis, m.moment), 1 / square), across, cross(along, across), along};
    orbit.moving = seen_from(orbit.start, orbit.fixed);
    orbit.pitch = slide / turn;
    orbit.turn = turn;
    return orbit;
}

} // namespace chasles::motion
