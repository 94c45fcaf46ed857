// Motions of the family in exact rationals, and the positions of points by definition: Rodrigues' formula with the
// cosine and sine of a half-angle tangent.
#pragma once

#include "chasles/motion/control_maps.h"
#include "tests/support/random.h"
#include "tests/support/rational.h"

namespace chasles::test {

using algebra::Matrix3;
using motion::RationalMotion;

template <class S>
RationalMotion<S> rounded_to(const RationalMotion<Rational>& motion) {
    RationalMotion<S> result;
    result.end_cosine = rounded_to<S>(motion.end_cosine);
    result.axis = rounded_to<S>(motion.axis);
    result.moment = rounded_to<S>(motion.moment);
    result.displacement = rounded_to<S>(motion.displacement);
    result.origin = rounded_to<S>(motion.origin);
    for (int i = 0; i < 3; ++i)
        result.orientation.row[i] = rounded_to<S>(motion.orientation.row[i]);
    return result;
}

template <class S>
motion::ControlMaps<Rational> exact(const motion::ControlMaps<S>& maps) {
    return motion::transformed<Rational>(maps, [](const Bernstein<3, S>& p) { return exact(p); });
}

inline Vector3<Rational> value_at(const Vector3<Bernstein<3, Rational>>& p, const Rational& tau) {
    return {algebra::value_at(p.x, tau), algebra::value_at(p.y, tau), algebra::value_at(p.z, tau)};
}

/// Turns a vector about the direction of `axis`. The half-angle has the tangent |axis| / `cosine`.
inline Vector3<Rational> turned(const Vector3<Rational>& v, const Rational& cosine, const Vector3<Rational>& axis) {
    const Rational square = dot(axis, axis);
    if (square == 0)
        return v;
    const Vector3<Rational> along = scale(axis, Rational(dot(axis, v) / square));
    const Vector3<Rational> across = v - along;
    const Rational norm = cosine * cosine + square;
    return along + scale(across, Rational((cosine * cosine - square) / norm)) +
           scale(cross(axis, across), Rational(2 * cosine / norm));
}

/// One screw: a turn about the axis with the direction of `tangent` through `point`, by the half-angle tangent
/// |tangent|, and a slide by `slide` along the axis (or along any direction if there is no turn).
struct PlainScrew {
    Vector3<Rational> point;
    Vector3<Rational> tangent;
    Vector3<Rational> slide;

    [[nodiscard]] Vector3<Rational> position(const Vector3<Rational>& start, const Rational& tau) const {
        return point + turned(start - point, Rational(1), scale(tangent, tau)) + scale(slide, tau);
    }
    /// The start position of the body point that is at `place` at tau.
    [[nodiscard]] Vector3<Rational> start_of(const Vector3<Rational>& place, const Rational& tau) const {
        return point + turned(place - scale(slide, tau) - point, Rational(1), scale(tangent, Rational(-tau)));
    }
    /// The screw as a member of the family, for a body whose frame starts at the frame of the world.
    [[nodiscard]] RationalMotion<Rational> motion() const {
        return {Rational(1), tangent, cross(point, tangent), slide, {}, algebra::identity_matrix<Rational>()};
    }
};

} // namespace chasles::test
