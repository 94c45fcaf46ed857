// Motions of the family in exact rationals, and where they carry points by definition: cosines and sines of a
// half-angle tangent, in Rodrigues' formula.
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

/// What turns a point by the angle whose half has the tangent sine / cosine, about the direction of `axis`, whose
/// length is that sine for the cosine given.
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

/// One screw in plain words: about an axis with the direction of `tangent` through `point`, by the half-angle tangent
/// |tangent|, sliding by `slide` along it (or along any direction if nothing turns).
struct PlainScrew {
    Vector3<Rational> point;
    Vector3<Rational> tangent;
    Vector3<Rational> slide;

    [[nodiscard]] Vector3<Rational> position(const Vector3<Rational>& start, const Rational& tau) const {
        return point + turned(start - point, Rational(1), scale(tangent, tau)) + scale(slide, tau);
    }
    /// The body point, given at the start, that is at `place` at tau.
    [[nodiscard]] Vector3<Rational> start_of(const Vector3<Rational>& place, const Rational& tau) const {
        return point + turned(place - scale(slide, tau) - point, Rational(1), scale(tangent, Rational(-tau)));
    }
    /// As a member of the family, for a body whose frame starts as that of the world.
    [[nodiscard]] RationalMotion<Rational> motion() const {
        return {Rational(1), tangent, cross(point, tangent), slide, {}, algebra::identity_matrix<Rational>()};
    }
};

} // namespace chasles::test
