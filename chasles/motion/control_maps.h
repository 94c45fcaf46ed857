// A motion of the family as four affine maps and four positive weights, on [0, 1] or any part of it.
// Source: design and docs/derivations/02-rational-motion.md, where each line is derived.
#pragma once

#include "chasles/algebra/bernstein.h"
#include "chasles/algebra/unit_roundoff.h"
#include "chasles/motion/rational_motion.h"

#include <array>

namespace chasles::motion {

using algebra::Bernstein;

/// A motion as cubic polynomials over a positive weight W. For a body point b, a fixed point x, and the line through
/// b with direction u in the body's frame, all at the same tau:
///   rotation b + translation              = W * (position of b in the frame of the fixed body)
///   rotation^T x - inverse_translation    = W * (position of x in the body's frame)
///   rotation u                            = W * (direction of the line in the fixed frame)
///   rotation (b x u) + moment u           = W * (moment of the line in the fixed frame)
/// W is 1 at the start in scalars with division, and some positive number in others.
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

/// Power coefficients of a polynomial of degree at most three whose values are scalars, vectors or matrices.
template <class T>
using Power = std::array<T, 4>;

/// (a[0] + a[1] tau) * (b[0] + b[1] tau + b[2] tau^2) for any bilinear product.
template <class A, class B, class Product>
auto multiply(const std::array<A, 2>& a, const Power<B>& b, Product times) {
    using T = decltype(times(a[0], b[0]));
    return Power<T>{times(a[0], b[0]), times(a[0], b[1]) + times(a[1], b[0]), times(a[0], b[2]) + times(a[1], b[1]),
                    times(a[1], b[2])};
}

template <class T>
Power<T> sum(const Power<T>& a, const Power<T>& b) {
    return {a[0] + b[0], a[1] + b[1], a[2] + b[2], a[3] + b[3]};
}

/// The Bernstein form of one component: c_k = sum over j of binomial(k, j) / binomial(3, j) p_j; three times that
/// where a third is not to be had.
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

template <class S>
Vector3<Bernstein<3, S>> vector_polynomial(const Power<Vector3<S>>& p) {
    Vector3<Bernstein<3, S>> result;
    for (int i = 0; i < 3; ++i)
        result[i] = polynomial<S>(p[0][i], p[1][i], p[2][i], p[3][i]);
    return result;
}

template <class S>
Matrix3<Bernstein<3, S>> matrix_polynomial(const Power<Matrix3<S>>& p) {
    Matrix3<Bernstein<3, S>> result;
    for (int i = 0; i < 3; ++i)
        result.row[i] = vector_polynomial<S>({p[0].row[i], p[1].row[i], p[2].row[i], p[3].row[i]});
    return result;
}

template <class S>
Power<Matrix3<S>> transposed(const Power<Matrix3<S>>& p) {
    return {p[0].transposed(), p[1].transposed(), p[2].transposed(), p[3].transposed()};
}

} // namespace detail

/// The control maps on [0, 1]. Source: docs/derivations/02-rational-motion.md, where each line is derived.
template <class S>
ControlMaps<S> control_maps(const RationalMotion<S>& motion) {
    using Matrix = Matrix3<S>;
    using Vector = Vector3<S>;
    const S& one = motion.turn_unit;
    const S two = S(2) * one;
    const S bend = motion.end_cosine - one; // e(tau) = one + bend tau
    const Matrix identity = algebra::identity_matrix<S>();
    const Matrix a = cross_matrix(motion.axis);
    const Matrix m = cross_matrix(motion.moment);
    const S square = bend * bend + dot(motion.axis, motion.axis);

    const detail::Power<S> weight{S(one * one), S(two * bend), square, S(0)};
    const detail::Power<Matrix> turn{scale(identity, S(one * one)), scale(identity, S(two * bend)) + scale(a, two),
                                     scale(identity, square) + scale(a, S(S(2) * bend)) + scale(a * a, S(2)), Matrix()};
    const std::array<Vector, 2> travel{motion.origin, motion.displacement};
    const std::array<Matrix, 2> travel_cross{cross_matrix(motion.origin), cross_matrix(motion.displacement)};

    const Vector axis_moment = cross(motion.axis, motion.moment);
    const Vector bent_moment = scale(motion.moment, bend);
    const detail::Power<Vector> swing{Vector(), scale(motion.moment, two), scale(bent_moment + axis_moment, S(2)),
                                      Vector()};
    const detail::Power<Vector> inverse_swing{Vector(), scale(motion.moment, two),
                                              scale(bent_moment - axis_moment, S(2)), Vector()};
    const detail::Power<Matrix> swing_moment{
        Matrix(), scale(m, two), scale(scale(m, bend) + a * m + outer(motion.axis, motion.moment), S(2)), Matrix()};

    const auto vector_times = [](const Vector& v, const S& s) { return scale(v, s); };
    const auto matrix_times = [](const Matrix& x, const Matrix& y) { return x * y; };
    const auto transposed_times = [](const Vector& v, const Matrix& x) { return x * v; };
    const detail::Power<Vector> shift = detail::sum(swing, detail::multiply(travel, weight, vector_times));
    const detail::Power<Vector> inverse_shift =
        detail::sum(inverse_swing, detail::multiply(travel, detail::transposed(turn), transposed_times));
    const detail::Power<Matrix> moment = detail::sum(swing_moment, detail::multiply(travel_cross, turn, matrix_times));

    // From the start orientation's axes to the body's own.
    const Matrix& orientation = motion.orientation;
    const auto in_body = [&](const detail::Power<Matrix>& p) {
        return detail::Power<Matrix>{p[0] * orientation, p[1] * orientation, p[2] * orientation, p[3] * orientation};
    };
    const Matrix back = orientation.transposed();
    ControlMaps<S> maps{detail::polynomial<S>(weight[0], weight[1], weight[2], weight[3]),
                        detail::matrix_polynomial<S>(in_body(turn)), detail::vector_polynomial<S>(shift),
                        detail::vector_polynomial<S>({back * inverse_shift[0], back * inverse_shift[1],
                                                      back * inverse_shift[2], back * inverse_shift[3]}),
                        detail::matrix_polynomial<S>(in_body(moment))};
    if constexpr (!algebra::Divisible<S>) { // all five over one unit
        const S& length = motion.length_unit;
        maps.weight = maps.weight * S(length * motion.orientation_unit);
        maps.translation = scale(maps.translation, motion.orientation_unit);
        maps.rotation = scale(maps.rotation, length);
    }
    return maps;
}

/// A function applied to every polynomial of a set of control maps.
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

/// The same motion on [from, to], a part of [0, 1].
template <class S>
ControlMaps<S> restricted(const ControlMaps<S>& maps, const S& from, const S& to) {
    return transformed<S>(maps, algebra::Restriction<3, S>(from, to));
}

/// The maps rounded to double precision.
template <class S>
ControlMaps<double> rounded(const ControlMaps<S>& maps) {
    return transformed<double>(maps, [](const Bernstein<3, S>& p) { return algebra::converted<double>(p); });
}

/// By 14 degrees at most: |a| <= 1/8.
inline bool is_small_rotation(const RationalMotion<algebra::DoubleDouble>& motion) {
    return double(dot(motion.axis, motion.axis)) <= 0x1p-6;
}

/// What the reach of the moving body is to be enlarged by where errors of such maps are bounded: the size of the terms
/// that they are made of.
inline double rounding_extent(const RationalMotion<algebra::DoubleDouble>& motion) {
    return is_small_rotation(motion) ? double(norm1(motion.moment)) + double(norm1(motion.displacement)) : 0;
}

/// The maps in double precision: of a motion that is rounded first where it turns by little, which takes a tenth of the
/// time, and otherwise rounded last (docs/derivations/10-error-bounds.md, "Maps in double precision").
inline ControlMaps<double> double_maps(const RationalMotion<algebra::DoubleDouble>& motion) {
    return is_small_rotation(motion) ? control_maps(rounded(motion)) : rounded(control_maps(motion));
}

} // namespace chasles::motion
