// The two motions of the library by their definitions, in exact rationals. Quaternions turn vectors by q v q*. A screw
// turns about a fixed point of the whole turn; a sweep turns about a point that moves along a line.
#pragma once

#include "tests/support/exact_reference_roots.h"

#include <Eigen/Geometry>

namespace chasles::reference {

using Triple = std::array<Rational, 3>;

struct Turn {
    Rational w{1};
    Triple v{};

    friend Turn operator*(const Turn& a, const Turn& b) {
        const Triple c{a.v[1] * b.v[2] - a.v[2] * b.v[1], a.v[2] * b.v[0] - a.v[0] * b.v[2],
                       a.v[0] * b.v[1] - a.v[1] * b.v[0]};
        Turn result{Rational(a.w * b.w - a.v[0] * b.v[0] - a.v[1] * b.v[1] - a.v[2] * b.v[2]), {}};
        for (std::size_t i = 0; i < 3; ++i)
            result.v[i] = a.w * b.v[i] + b.w * a.v[i] + c[i];
        return result;
    }
    [[nodiscard]] Turn conjugate() const { return {w, {-v[0], -v[1], -v[2]}}; }
    [[nodiscard]] Rational norm() const { return w * w + v[0] * v[0] + v[1] * v[1] + v[2] * v[2]; }
};

inline Triple operator+(const Triple& a, const Triple& b) {
    return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
inline Triple operator-(const Triple& a, const Triple& b) {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
inline Triple times(const Triple& a, const Rational& s) {
    return {a[0] * s, a[1] * s, a[2] * s};
}
inline Rational inner(const Triple& a, const Triple& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// q v q* / |q|^2.
inline Triple turned(const Triple& v, const Turn& q) {
    return times((q * Turn{Rational(0), v} * q.conjugate()).v, Rational(1 / q.norm()));
}

struct ExactPose {
    Triple translation{};
    Turn rotation;
};

inline Triple exact(const Eigen::Vector3d& v) {
    return {Rational(v.x()), Rational(v.y()), Rational(v.z())};
}

/// The exact pose of any type with a translation and a quaternion of doubles.
template <class Pose>
ExactPose exact_pose(const Pose& pose) {
    const auto& q = pose.rotation;
    return {exact(Eigen::Vector3d(pose.translation)),
            {Rational(q.w()), {Rational(q.x()), Rational(q.y()), Rational(q.z())}}};
}

/// `pose` in the frame `frame`.
inline ExactPose seen_from(const ExactPose& frame, const ExactPose& pose) {
    const Turn back = frame.rotation.conjugate();
    return {turned(pose.translation - frame.translation, back), back * pose.rotation};
}

/// The body point b is at (turn b + shift) / weight.
template <class N>
struct MotionPath {
    std::array<Vector<N, 2>, 3> turn; ///< rows
    Vector<N, 3> shift;
    Polynomial<N, 2> weight;

    template <class P>
    [[nodiscard]] auto turned(const std::array<P, 3>& v) const {
        return std::array{dot(turn[0], v), dot(turn[1], v), dot(turn[2], v)};
    }
};

namespace detail {

/// Quaternions whose components are linear in tau.
struct LinearTurn {
    Polynomial<Rational, 1> w;
    Vector<Rational, 1> v;

    friend LinearTurn operator*(const LinearTurn& a, const Turn& b) {
        const Vector<Rational, 0> bv = constant(b.v);
        return {a.w * b.w - dot(a.v, bv), sum(sum(scaled(bv, a.w), scaled(a.v, b.w)), cross(a.v, bv))};
    }
    [[nodiscard]] Polynomial<Rational, 2> norm() const { return w * w + dot(v, v); }
    /// Row by row, times norm(): q x q* = (w^2 - v.v) x + 2 (v.x) v + 2 w v x x.
    [[nodiscard]] std::array<Vector<Rational, 2>, 3> matrix() const {
        std::array<Vector<Rational, 2>, 3> rows;
        const Polynomial<Rational, 2> even = w * w - dot(v, v);
        const Rational two(2);
        for (std::size_t i = 0; i < 3; ++i) {
            const std::size_t j = (i + 1) % 3;
            const std::size_t k = (i + 2) % 3;
            rows[i][i] = even + v[i] * v[i] * two;
            rows[i][j] = (v[i] * v[j] - w * v[k]) * two;
            rows[i][k] = (v[i] * v[k] + w * v[j]) * two;
        }
        return rows;
    }
};

/// The path of a body with the start orientation `start` that turns by q about its point `centre` (in its own frame),
/// while this point moves along a line by `way` from `from`.
inline MotionPath<Rational> path_about(const Turn& start, const LinearTurn& q, const Triple& centre, const Triple& from,
                                       const Triple& way) {
    MotionPath<Rational> path;
    const LinearTurn whole = q * start;
    path.turn = whole.matrix();
    path.weight = whole.norm();
    const Vector<Rational, 2> arm = path.turned(constant(centre));
    for (std::size_t i = 0; i < 3; ++i)
        path.shift[i] = path.weight * Polynomial<Rational, 1>{from[i], way[i]} - arm[i];
    return path;
}

inline Rational square_root(const Rational& x) {
    const Integer top = sqrt(Integer(numerator(x)));
    const Integer bottom = sqrt(Integer(denominator(x)));
    if (Rational(Integer(top * top), Integer(bottom * bottom)) != x)
        throw std::logic_error("exact reference: a sweep needs quaternions whose lengths are rational");
    return {top, bottom};
}

inline Turn shorter_turn(const ExactPose& start, const ExactPose& goal) {
    const Turn turn = goal.rotation * start.rotation.conjugate();
    return turn.w < 0 ? Turn{Rational(-turn.w), times(turn.v, Rational(-1))} : turn;
}

} // namespace detail

/// The paper's screw, in the frame of the fixed body; not for a half turn.
inline MotionPath<Rational> screw_path(const ExactPose& start, const ExactPose& goal) {
    const Turn turn = detail::shorter_turn(start, goal);
    const Triple shift = goal.translation - start.translation;
    const Rational square = inner(turn.v, turn.v);
    detail::LinearTurn q{{turn.w, Rational(0)}, {}};
    if (square == 0)
        return detail::path_about(start.rotation, q, {}, start.translation, shift);
    if (turn.w == 0)
        throw std::logic_error("exact reference: a screw by a half turn");
    for (std::size_t i = 0; i < 3; ++i)
        q.v[i] = {Rational(0), turn.v[i]};
    const Triple along = times(turn.v, Rational(inner(turn.v, shift) / square));
    const Triple across = shift - along;
    // The fixed point of the motion in the plane of `across`: the turn about this point moves start to start + across.
    const Triple sideways = (Turn{Rational(0), turn.v} * Turn{Rational(0), across}).v;
    const Triple axis_point =
        start.translation + times(across, Rational(1, 2)) + times(sideways, Rational(turn.w / (2 * square)));
    const Triple centre = turned(axis_point - start.translation, start.rotation.conjugate());
    return detail::path_about(start.rotation, q, centre, axis_point, along);
}

/// The sweep about a point of the body. The product of the quaternions' lengths must be rational.
inline MotionPath<Rational> sweep_path(const ExactPose& start, const ExactPose& goal, const Triple& centre = {}) {
    const Turn turn = detail::shorter_turn(start, goal);
    const Rational length = detail::square_root(turn.norm());
    detail::LinearTurn q{{length, Rational(turn.w - length)}, {}};
    for (std::size_t i = 0; i < 3; ++i)
        q.v[i] = {Rational(0), turn.v[i]};
    const Triple from = start.translation + turned(centre, start.rotation);
    const Triple to = goal.translation + turned(centre, goal.rotation);
    return detail::path_about(start.rotation, q, centre, from, to - from);
}

/// Calls function(coefficient, is_length) for each of two paths' coefficients side by side.
template <class A, class B, class Function>
void for_coefficients(const MotionPath<A>& a, MotionPath<B>& b, Function function) {
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j)
            for (std::size_t k = 0; k < a.turn[i][j].size(); ++k)
                function(a.turn[i][j][k], b.turn[i][j][k], false);
        for (std::size_t k = 0; k < a.shift[i].size(); ++k)
            function(a.shift[i][k], b.shift[i][k], true);
    }
    for (std::size_t k = 0; k < a.weight.size(); ++k)
        function(a.weight[k], b.weight[k], false);
}

/// The path in whole numbers, with lengths in units of 2^-bits. Position numerators and weight share one factor.
inline MotionPath<Integer> whole_numbers(const MotionPath<Rational>& path, unsigned bits) {
    MotionPath<Rational> scaled = path;
    Integer multiple(1);
    const Rational unit(Integer(Integer(1) << bits));
    for_coefficients(path, scaled, [&](const Rational& from, Rational& to, bool is_length) {
        to = is_length ? Rational(from * unit) : from;
        multiple = lcm(multiple, Integer(denominator(to)));
    });
    MotionPath<Integer> result;
    Integer divisor(0);
    for_coefficients(scaled, result, [&](const Rational& from, Integer& to, bool) {
        to = Integer(numerator(from)) * Integer(multiple / Integer(denominator(from)));
        divisor = gcd(divisor, to);
    });
    MotionPath<Integer> shortened;
    for_coefficients(result, shortened, [&](const Integer& from, Integer& to, bool) { to = from / divisor; });
    return shortened;
}

/// The path in doubles, with lengths in units of 2^exponent. Each coefficient is rounded once.
inline MotionPath<Tracked> doubles(const MotionPath<Rational>& path, int exponent) {
    MotionPath<Tracked> result;
    double largest = 0;
    for (const Rational& c : path.weight)
        largest = std::max(largest, std::abs(static_cast<double>(c)));
    const int weight_exponent = std::ilogb(largest);
    for_coefficients(path, result, [&](const Rational& from, Tracked& to, bool is_length) {
        to.value = std::ldexp(static_cast<double>(from), -weight_exponent - (is_length ? exponent : 0));
        to.size = std::abs(to.value);
    });
    return result;
}

} // namespace chasles::reference
