// Rational motions, in any scalar: the paper's screw and the sweep. All their elementary equations are cubic.
// Legend (docs/derivations/02-rational-motion.md): quaternion q(tau) = e(tau) + tau a with e(tau) = 1 + tau (e1 - 1);
// weight W = |q|^2; moment m, perpendicular to a; displacement d.
#pragma once

#include "chasles/algebra/double_double.h"
#include "chasles/algebra/vector.h"

namespace chasles::motion {

using algebra::Matrix3;
using algebra::Vector3;

/// A quaternion w + v of any length.
template <class S>
struct Quaternion {
    S w{};
    Vector3<S> v;

    friend Quaternion operator*(const Quaternion& a, const Quaternion& b) {
        return {S(a.w * b.w - dot(a.v, b.v)), scale(b.v, a.w) + scale(a.v, b.w) + cross(a.v, b.v)};
    }
    [[nodiscard]] Quaternion conjugate() const { return {w, Vector3<S>() - v}; }
    [[nodiscard]] S squared_norm() const { return w * w + dot(v, v); }
};

/// The rotation matrix of a quaternion of any non-zero length, times its squared norm.
template <class S>
Matrix3<S> scaled_rotation_matrix(const Quaternion<S>& q) {
    const S two(2); // square I + 2 v v^T + 2 w [v], without the products with zeros and ones
    const S square = q.w * q.w - dot(q.v, q.v);
    const S xy = S(q.v.x * q.v.y) * two, yz = S(q.v.y * q.v.z) * two, zx = S(q.v.z * q.v.x) * two;
    const Vector3<S> turned = scale(q.v, S(two * q.w));
    return {{{S(square + S(q.v.x * q.v.x) * two), S(xy - turned.z), S(zx + turned.y)},
             {S(xy + turned.z), S(square + S(q.v.y * q.v.y) * two), S(yz - turned.x)},
             {S(zx - turned.y), S(yz + turned.x), S(square + S(q.v.z * q.v.z) * two)}}};
}

/// The rotation matrix of a quaternion of any non-zero length.
template <class S>
Matrix3<S> rotation_matrix(const Quaternion<S>& q) {
    return scale(scaled_rotation_matrix(q), S(S(1) / q.squared_norm()));
}

/// The vector rotated by a quaternion of any non-zero length.
template <class S>
[[gnu::always_inline]] inline Vector3<S> rotated(const Quaternion<S>& q, const Vector3<S>& vector) {
    const Vector3<S> across = cross(q.v, vector);
    return vector + scale(scale(across, q.w) + cross(q.v, across), S(S(2) / q.squared_norm()));
}

/// A pose with a quaternion of any non-zero length.
template <class S>
struct GeneralPose {
    Vector3<S> translation;
    Quaternion<S> rotation;
};

/// Where a body point is.
template <class S>
[[gnu::always_inline]] inline Vector3<S> placed(const GeneralPose<S>& pose, const Vector3<S>& point) {
    return rotated(pose.rotation, point) + pose.translation;
}

/// `inner`, carried by `outer`. No quaternion is normalized.
template <class S>
GeneralPose<S> product(const GeneralPose<S>& outer, const GeneralPose<S>& inner) {
    return {placed(outer, inner.translation), outer.rotation * inner.rotation};
}

/// `pose` relative to `frame`. Both are given in one common frame.
template <class S>
GeneralPose<S> seen_from(const GeneralPose<S>& frame, const GeneralPose<S>& pose) {
    const Quaternion<S> back = frame.rotation.conjugate();
    return {rotation_matrix(back) * (pose.translation - frame.translation), back * pose.rotation};
}

/// One rational motion. If all units are 1, a body point b starts at y = `orientation` * b relative to `origin`. At tau
/// it is at origin + (W y + 2 tau e (a x y + m) + 2 tau^2 a x (a x y + m)) / W + tau d. Other units let exact scalars
/// avoid division: e1 and a are then multiples of 1 / turn_unit, origin and d of 1 / length_unit, m of 1 / (turn_unit
/// length_unit), and the orientation of 1 / orientation_unit.
template <class S>
struct RationalMotion {
    S end_cosine{};          ///< e1
    Vector3<S> axis;         ///< a; for a screw the half-angle tangent times the axis direction
    Vector3<S> moment;       ///< m, a length
    Vector3<S> displacement; ///< d, a length
    Vector3<S> origin;       ///< position of the body's origin at the start, in the frame of the fixed body
    Matrix3<S> orientation;  ///< at the start
    /// 1-norm of a sweep's reference point in the body's frame, in the length unit; 0 for a screw.
    double reference_extent = 0;
    S turn_unit = S(1);
    S length_unit = S(1);
    S orientation_unit = S(1);
};

/// The rotation from the start orientation to the goal orientation, with non-negative scalar part.
template <class S>
Quaternion<S> turn_between(const GeneralPose<S>& start, const GeneralPose<S>& goal) {
    const Quaternion<S> turn = goal.rotation * start.rotation.conjugate();
    return turn.w < S(0) ? Quaternion<S>{S(S(0) - turn.w), Vector3<S>() - turn.v} : turn;
}

/// The screw between two poses, which must not be a half turn apart. The result is exact if S is exact: the formulas
/// need no square root. `turn` is turn_between(start, goal). Source: docs/derivations/01-screw-from-two-poses.md.
template <class S>
RationalMotion<S> screw_between(const GeneralPose<S>& start, const GeneralPose<S>& goal, const Quaternion<S>& turn) {
    const Vector3<S> axis = scale(turn.v, S(S(1) / turn.w));
    const Vector3<S> shift = goal.translation - start.translation;
    const S square = dot(turn.v, turn.v);
    const bool turns = S(0) < square;
    const Vector3<S> along = turns ? scale(turn.v, S(dot(turn.v, shift) / square)) : shift;
    const Vector3<S> across = shift - along;
    static const S half = S(1) / S(2);
    const Vector3<S> moment = scale(across - cross(axis, across), half);
    return {S(1), axis, moment, along, start.translation, rotation_matrix(start.rotation)};
}
template <class S>
RationalMotion<S> screw_between(const GeneralPose<S>& start, const GeneralPose<S>& goal) {
    return screw_between(start, goal, turn_between(start, goal));
}

/// The sweep about the body point `centre`. `unit_turn` is the rotation from start to goal as a unit quaternion.
template <class S>
RationalMotion<S> sweep_between(const GeneralPose<S>& start, const GeneralPose<S>& goal, const Quaternion<S>& unit_turn,
                                const Vector3<S>& centre) {
    const Matrix3<S> orientation = rotation_matrix(start.rotation);
    const Vector3<S> reference = orientation * centre;
    const Vector3<S> moved = rotation_matrix(goal.rotation) * centre;
    const Vector3<S> displacement = (goal.translation - start.translation) + (moved - reference);
    return {unit_turn.w,       unit_turn.v, cross(reference, unit_turn.v),     displacement,
            start.translation, orientation, static_cast<double>(norm1(centre))};
}

/// The motion in double-double, without rounding.
inline RationalMotion<algebra::DoubleDouble> widened(const RationalMotion<double>& motion) {
    using Wide = algebra::DoubleDouble;
    const auto vector = [](const Vector3<double>& v) { return Vector3<Wide>{Wide(v.x), Wide(v.y), Wide(v.z)}; };
    const Matrix3<double>& turn = motion.orientation;
    return {Wide(motion.end_cosine), vector(motion.axis),
            vector(motion.moment),   vector(motion.displacement),
            vector(motion.origin),   {vector(turn.row[0]), vector(turn.row[1]), vector(turn.row[2])},
            motion.reference_extent};
}

/// The vector rounded to double.
inline Vector3<double> in_double(const Vector3<algebra::DoubleDouble>& v) {
    return {double(v.x), double(v.y), double(v.z)};
}

/// The motion with every number rounded to double.
inline RationalMotion<double> rounded(const RationalMotion<algebra::DoubleDouble>& motion) {
    const Matrix3<algebra::DoubleDouble>& turn = motion.orientation;
    return {double(motion.end_cosine), in_double(motion.axis),
            in_double(motion.moment),  in_double(motion.displacement),
            in_double(motion.origin),  {in_double(turn.row[0]), in_double(turn.row[1]), in_double(turn.row[2])},
            motion.reference_extent};
}

} // namespace chasles::motion
