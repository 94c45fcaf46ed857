// Turns in multiprecision.
#pragma once

#include "tests/attack/true_motion.h"

namespace chasles::attack {

struct WideQuaternion {
    Wide w;
    WideVector v;
};

/// Normalised.
inline WideQuaternion unit_of(const Pose& pose) {
    const auto& q = pose.rotation;
    WideQuaternion wide{Wide(q.w()), widened({q.x(), q.y(), q.z()})};
    const Wide length = sqrt(wide.w * wide.w + wide.v.squaredNorm());
    return {wide.w / length, wide.v / length};
}

inline WideMatrix cross_matrix(const WideVector& v) {
    WideMatrix m;
    m << Wide(0), -v.z(), v.y(), v.z(), Wide(0), -v.x(), -v.y(), v.x(), Wide(0);
    return m;
}

inline WideMatrix matrix_of(const WideQuaternion& q) {
    const WideMatrix k = cross_matrix(q.v);
    return WideMatrix::Identity() + k * (2 * q.w) + k * k * Wide(2);
}

/// Rodrigues' formula: I + sin K + (1 - cos) K^2. The direction has unit length.
inline WideMatrix turn_about(const WideVector& direction, const Wide& angle) {
    const WideMatrix k = cross_matrix(direction);
    const Wide half = sin(angle / 2);
    return WideMatrix::Identity() + k * Wide(sin(angle)) + k * k * Wide(2 * half * half);
}

/// An even turn, the shorter way round. At a share of its angle the matrix is turned(share * angle) * from.
struct EvenTurn {
    WideMatrix from;
    WideVector direction; ///< of unit length
    Wide angle;           ///< in [0, pi]

    EvenTurn(const Pose& start, const Pose& goal) {
        const WideQuaternion a = unit_of(start);
        const WideQuaternion b = unit_of(goal);
        from = matrix_of(a);
        // b times the conjugate of a
        WideQuaternion turn{b.w * a.w + b.v.dot(a.v), b.v * a.w - a.v * b.w - b.v.cross(a.v)};
        if (abs(turn.w) < Wide(1e-70)) // rounding of a half turn: both ways are equally long
            turn.w = 0;
        if (turn.w < 0) // the shorter way round
            turn = {-turn.w, -turn.v};
        const Wide sine = turn.v.norm();
        const bool turns = sine > Wide(1e-70); // less is rounding: quaternions of doubles differ by more
        angle = turns ? Wide(2 * atan2(sine, turn.w)) : Wide(0);
        direction = turns ? WideVector(turn.v / sine) : WideVector(WideVector::UnitZ());
    }

    /// The turn since the start.
    [[nodiscard]] WideMatrix turned(const Wide& by) const { return turn_about(direction, by); }
};

} // namespace chasles::attack
