// A rational motion as polynomial maps over a positive weight in Bernstein form, on [0, 1] or any part of it.
// Source: docs/derivations/02-rational-motion.md derives each formula.
#pragma once

#include "chasles/algebra/bernstein.h"
#include "chasles/algebra/unit_roundoff.h"
#include "chasles/motion/rational_motion.h"

#include <array>

namespace chasles::motion {

using algebra::Bernstein;

/// A motion as cubic polynomials over a positive weight W. For a body point b, a fixed point x, and the line through b
/// with direction u in the body's frame, at any tau:
///   rotation b + translation              = W * (position of b in the frame of the fixed body)
///   rotation^T x - inverse_translation    = W * (position of x in the body's frame)
///   rotation u                            = W * (direction of the line in the fixed frame)
///   rotation (b x u) + moment u           = W * (moment of the line in the fixed frame)
/// W(0) is 1 in scalars with division and some positive number in other scalars.
template <class S>
struct ControlMaps {
    using Polynomial = Bernstein<3, S>;
    Polynomial weight;
    Matrix3<Polynomial> rotation;
    Vector3<Polynomial> translation;
    Vector3<Polynomial> inverse_translation;
    Matrix3<Polynomial> moment;
};

namespace detail {

/// The power coefficients of a polynomial of degree at most three with scalar, vector or matrix values.
template <class T>
using Power = std::array<T, 4>;

/// (a[0] + a[1] tau) * (b[0] + b[1] tau + b[2] tau^2) for any bilinear product `times`.
template <class A, class B, class Product>
auto multiply(const std::array<A, 2>& a, const Power<B>& b, Product times) {
    using T = decltype(times(a[0], b[0]));
    return Power<T>{times(a[0], b[0]), times(a[0], b[1]) + times(a[1], b[0]), times(a[0], b[2]) + times(a[1], b[1]),
                    times(a[1], b[2])};
}

/// The sum of two polynomials.
template <class T>
Power<T> sum(const Power<T>& a, const Power<T>& b) {
    return {a[0] + b[0], a[1] + b[1], a[2] + b[2], a[3] + b[3]};
}

/// The Bernstein form of one component: c_k = sum over j of binomial(k, j) / binomial(3, j) p_j. In scalars without
/// division the result is three times this form.
template <class S>
Bernstein<3, S> polynomial(const S& p0, const S& p1, const S& p2, const S& p3) {
    Bernstein<3, S> result;
    if constexpr (algebra::Divisible<S>) {
        static const S third = S(1) / S(3);
        result.set(0, p0);
        result.set(1, S(p0 + p1 * third));
        result.set(2, S(p0 + (p1 + p1 + p2) * third));
        result.set(3, S(p0 + p1 + p2 + p3));
    } else {
        const S three(3);
        result.set(0, S(three * p0));
        result.set(1, S(three * p0 + p1));
        result.set(2, S(three * p0 + (p1 + p1 + p2)));
        result.set(3, S(three * (p0 + p1 + p2 + p3)));
    }
    return result;
}

/// The Bernstein form of a vector polynomial.
template <class S>
Vector3<Bernstein<3, S>> vector_polynomial(const Power<Vector3<S>>& p) {
    Vector3<Bernstein<3, S>> result;
    for (int i = 0; i < 3; ++i)
        result[i] = polynomial<S>(p[0][i], p[1][i], p[2][i], p[3][i]);
    return result;
}

/// The Bernstein form of a matrix polynomial.
template <class S>
Matrix3<Bernstein<3, S>> matrix_polynomial(const Power<Matrix3<S>>& p) {
    Matrix3<Bernstein<3, S>> result;
    for (int i = 0; i < 3; ++i)
        result.row[i] = vector_polynomial<S>({p[0].row[i], p[1].row[i], p[2].row[i], p[3].row[i]});
    return result;
}

/// The transposed matrix polynomial.
template <class S>
Power<Matrix3<S>> transposed(const Power<Matrix3<S>>& p) {
    return {p[0].transposed(), p[1].transposed(), p[2].transposed(), p[3].transposed()};
}

/// The terms that several maps share, in the notation of note 02: e(tau) = one + bend tau, square = bend^2 + a . a.
template <class S>
struct MotionTerms {
    const RationalMotion<S>& motion;
    const S& one; ///< the turn unit
    S two;
    S bend;
    S square;
    Matrix3<S> a; ///< the cross product matrix of the axis
    Vector3<S> axis_moment;
    Vector3<S> bent_moment;

    explicit MotionTerms(const RationalMotion<S>& given)
        : motion(given), one(given.turn_unit), two(S(2) * one), bend(given.end_cosine - one),
          square(bend * bend + dot(given.axis, given.axis)), a(cross_matrix(given.axis)),
          axis_moment(cross(given.axis, given.moment)), bent_moment(scale(given.moment, bend)) {}
};

// The power coefficients of the five maps, for body axes that are parallel to the fixed axes at the start.

template <class S>
Power<S> weight_of(const MotionTerms<S>& terms) {
    return {S(terms.one * terms.one), S(terms.two * terms.bend), terms.square, S(0)};
}

template <class S>
Power<Matrix3<S>> rotation_of(const MotionTerms<S>& terms) {
    const Matrix3<S> identity = algebra::identity_matrix<S>();
    const Matrix3<S>& a = terms.a;
    return {scale(identity, S(terms.one * terms.one)), scale(identity, S(terms.two * terms.bend)) + scale(a, terms.two),
            scale(identity, terms.square) + scale(a, S(S(2) * terms.bend)) + scale(a * a, S(2)), Matrix3<S>()};
}

template <class S>
Power<Vector3<S>> translation_of(const MotionTerms<S>& terms, const Power<S>& weight) {
    const RationalMotion<S>& motion = terms.motion;
    const std::array<Vector3<S>, 2> travel{motion.origin, motion.displacement};
    const Power<Vector3<S>> swing{Vector3<S>(), scale(motion.moment, terms.two),
                                  scale(terms.bent_moment + terms.axis_moment, S(2)), Vector3<S>()};
    return sum(swing, multiply(travel, weight, [](const Vector3<S>& v, const S& s) { return scale(v, s); }));
}

template <class S>
Power<Vector3<S>> inverse_translation_of(const MotionTerms<S>& terms, const Power<Matrix3<S>>& rotation) {
    const RationalMotion<S>& motion = terms.motion;
    const std::array<Vector3<S>, 2> travel{motion.origin, motion.displacement};
    const Power<Vector3<S>> swing{Vector3<S>(), scale(motion.moment, terms.two),
                                  scale(terms.bent_moment - terms.axis_moment, S(2)), Vector3<S>()};
    const auto transposed_times = [](const Vector3<S>& v, const Matrix3<S>& x) { return x * v; };
    return sum(swing, multiply(travel, transposed(rotation), transposed_times));
}

template <class S>
Power<Matrix3<S>> moment_of(const MotionTerms<S>& terms, const Power<Matrix3<S>>& rotation) {
    const RationalMotion<S>& motion = terms.motion;
    const Matrix3<S> m = cross_matrix(motion.moment);
    const std::array<Matrix3<S>, 2> travel{cross_matrix(motion.origin), cross_matrix(motion.displacement)};
    const Power<Matrix3<S>> swing{Matrix3<S>(), scale(m, terms.two),
                                  scale(scale(m, terms.bend) + terms.a * m + outer(motion.axis, motion.moment), S(2)),
                                  Matrix3<S>()};
    const auto matrix_times = [](const Matrix3<S>& x, const Matrix3<S>& y) { return x * y; };
    return sum(swing, multiply(travel, rotation, matrix_times));
}

/// A linear function applied to all power coefficients.
template <class T, class Function>
Power<T> mapped(const Power<T>& p, Function function) {
    return {function(p[0]), function(p[1]), function(p[2]), function(p[3])};
}

} // namespace detail

/// The control maps on [0, 1].
template <class S>
ControlMaps<S> control_maps(const RationalMotion<S>& motion) {
    const detail::MotionTerms<S> terms(motion);
    const detail::Power<S> weight = detail::weight_of(terms);
    const detail::Power<Matrix3<S>> rotation = detail::rotation_of(terms);
    const Matrix3<S>& orientation = motion.orientation;
    const Matrix3<S> inverse_orientation = orientation.transposed();
    const auto in_body = [&](const Matrix3<S>& map) { return map * orientation; };
    const auto to_body = [&](const Vector3<S>& vector) { return inverse_orientation * vector; };
    ControlMaps<S> maps{
        detail::polynomial<S>(weight[0], weight[1], weight[2], weight[3]),
        detail::matrix_polynomial<S>(detail::mapped(rotation, in_body)),
        detail::vector_polynomial<S>(detail::translation_of(terms, weight)),
        detail::vector_polynomial<S>(detail::mapped(detail::inverse_translation_of(terms, rotation), to_body)),
        detail::matrix_polynomial<S>(detail::mapped(detail::moment_of(terms, rotation), in_body))};
    if constexpr (!algebra::Divisible<S>) { // brings all five maps to one unit
        const S& length = motion.length_unit;
        maps.weight = maps.weight * S(length * motion.orientation_unit);
        maps.translation = scale(maps.translation, motion.orientation_unit);
        maps.rotation = scale(maps.rotation, length);
    }
    return maps;
}

/// The control maps with a function applied to every polynomial.
template <class To, class From, class Function>
ControlMaps<To> transformed(const ControlMaps<From>& maps, Function function) {
    ControlMaps<To> result;
    result.weight = function(maps.weight);
    for (int i = 0; i < 3; ++i) {
        result.translation[i] = function(maps.translation[i]);
        result.inverse_translation[i] = function(maps.inverse_translation[i]);
        for (int j = 0; j < 3; ++j) {
            result.rotation.row[i][j] = function(maps.rotation.row[i][j]);
            result.moment.row[i][j] = function(maps.moment.row[i][j]);
        }
    }
    return result;
}

/// The same motion on [from, to], a part of [0, 1], mapped to [0, 1].
template <class S>
ControlMaps<S> restricted(const ControlMaps<S>& maps, const S& from, const S& to) {
    return transformed<S>(maps, algebra::Restriction<3, S>(from, to));
}

/// The maps rounded to double precision.
template <class S>
ControlMaps<double> rounded(const ControlMaps<S>& maps) {
    return transformed<double>(maps, [](const Bernstein<3, S>& p) { return algebra::converted<double>(p); });
}

/// Whether |a| <= 1/8: a screw then rotates by at most 14 degrees.
template <class S>
bool is_small_rotation(const RationalMotion<S>& motion) {
    return double(dot(motion.axis, motion.axis)) <= 0x1p-6;
}

/// The length that must be added to the extent of the moving body in error bounds of `double_maps`, in the length unit.
/// For a small rotation it is the size of the terms of the maps, otherwise 0.
inline double rounding_extent(const RationalMotion<algebra::DoubleDouble>& motion) {
    return is_small_rotation(motion) ? double(norm1(motion.moment)) + double(norm1(motion.displacement)) : 0;
}

/// The maps in double. For a small rotation, the motion is rounded to double first, which takes a tenth of the time.
/// Otherwise the maps are rounded last (docs/derivations/10-error-bounds.md, "Maps in double precision").
inline ControlMaps<double> double_maps(const RationalMotion<algebra::DoubleDouble>& motion) {
    return is_small_rotation(motion) ? control_maps(rounded(motion)) : rounded(control_maps(motion));
}
inline ControlMaps<double> double_maps(const RationalMotion<double>& motion) {
    return is_small_rotation(motion) ? control_maps(motion) : rounded(control_maps(widened(motion)));
}

} // namespace chasles::motion
