// Poses in a hundred digits, for motions that are no rational ones.
#pragma once

#include "chasles/motion/pose.h"

#include <array>
#include <boost/multiprecision/cpp_bin_float.hpp>

namespace chasles::test {

using Digits = boost::multiprecision::cpp_bin_float_100;

struct LongVector {
    std::array<Digits, 3> at{};

    LongVector() = default;
    LongVector(Digits x, Digits y, Digits z) : at{std::move(x), std::move(y), std::move(z)} {}
    explicit LongVector(const Eigen::Vector3d& v) : at{Digits(v.x()), Digits(v.y()), Digits(v.z())} {}

    friend LongVector operator+(const LongVector& a, const LongVector& b) {
        return {a.at[0] + b.at[0], a.at[1] + b.at[1], a.at[2] + b.at[2]};
    }
    friend LongVector operator-(const LongVector& a, const LongVector& b) {
        return {a.at[0] - b.at[0], a.at[1] - b.at[1], a.at[2] - b.at[2]};
    }
    friend LongVector operator*(const Digits& s, const LongVector& v) {
        return {s * v.at[0], s * v.at[1], s * v.at[2]};
    }
    [[nodiscard]] Digits norm() const { return sqrt(at[0] * at[0] + at[1] * at[1] + at[2] * at[2]); }
};

inline LongVector cross(const LongVector& a, const LongVector& b) {
    return {a.at[1] * b.at[2] - a.at[2] * b.at[1], a.at[2] * b.at[0] - a.at[0] * b.at[2],
            a.at[0] * b.at[1] - a.at[1] * b.at[0]};
}
inline Digits dot(const LongVector& a, const LongVector& b) {
    return a.at[0] * b.at[0] + a.at[1] * b.at[1] + a.at[2] * b.at[2];
}

/// The vector turned about a unit axis (Rodrigues).
inline LongVector turned(const LongVector& v, const LongVector& axis, const Digits& angle) {
    const LongVector across = cross(axis, v);
    return v + sin(angle) * across + (1 - cos(angle)) * cross(axis, across);
}

/// A rotation by an axis of unit length and an angle, and a translation.
struct LongPose {
    LongVector translation;
    LongVector axis{0, 0, 1};
    Digits angle = 0;

    explicit LongPose(const Pose& pose) : translation(pose.translation) {
        const LongVector v(Eigen::Vector3d(pose.rotation.vec()));
        const Digits w(pose.rotation.w()), sine = v.norm();
        if (sine > 0)
            axis = (1 / sine) * v;
        angle = 2 * atan2(sine, w);
    }
    [[nodiscard]] LongVector operator()(const LongVector& point) const {
        return turned(point, axis, angle) + translation;
    }
};

/// The turn from one orientation to another, the shorter way round.
inline LongPose turn_between(const Pose& from, const Pose& to) {
    const Digits aw(from.rotation.w()), bw(to.rotation.w());
    const LongVector av(Eigen::Vector3d(from.rotation.vec())), bv(Eigen::Vector3d(to.rotation.vec()));
    // to * conjugate(from)
    Digits w = aw * bw + dot(av, bv);
    LongVector v = aw * bv - bw * av - cross(bv, av);
    if (w < 0) {
        w = -w;
        v = Digits(-1) * v;
    }
    LongPose turn{Pose()};
    const Digits sine = v.norm();
    if (sine > 0)
        turn.axis = (1 / sine) * v;
    turn.angle = 2 * atan2(sine, w);
    return turn;
}

/// Where a body point is at a time of slerp with `centre` on a straight line.
inline LongVector at_constant_velocity(const Pose& start, const Pose& goal, const Eigen::Vector3d& centre,
                                       const Eigen::Vector3d& point, const Digits& time) {
    const LongPose from(start), to(goal), turn = turn_between(start, goal);
    const LongVector at_start = from(LongVector(centre)), at_goal = to(LongVector(centre));
    const LongVector arm = from(LongVector(point)) - at_start;
    return at_start + time * (at_goal - at_start) + turned(arm, turn.axis, time * turn.angle);
}

/// Where a body point is at a time of a uniform helix.
inline LongVector at_constant_twist(const Pose& start, const Pose& goal, const Eigen::Vector3d& point,
                                    const Digits& time) {
    const LongPose from(start), turn = turn_between(start, goal);
    const LongVector shift = LongVector(goal.translation) - LongVector(start.translation);
    if (turn.angle == 0)
        return from(LongVector(point)) + time * shift;
    const LongVector along = dot(turn.axis, shift) * turn.axis;
    const LongVector across = shift - along;
    // The start of the body's origin, seen from the axis: across = (turn - identity) arm.
    const Digits cotangent = cos(turn.angle / 2) / sin(turn.angle / 2);
    const LongVector arm = Digits(-0.5) * (across + cotangent * cross(turn.axis, across));
    const LongVector on_axis = LongVector(start.translation) - arm;
    return on_axis + time * along + turned(from(LongVector(point)) - on_axis, turn.axis, time * turn.angle);
}

} // namespace chasles::test
