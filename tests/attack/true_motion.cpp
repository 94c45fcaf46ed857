#include "tests/attack/true_motion.h"

namespace chasles::attack {

namespace {

/// Covers the rounding of a bound to double.
constexpr double outward = 1 + 1e-12;

struct WideQuaternion {
    Wide w;
    WideVector v;
};

WideQuaternion unit_of(const Pose& pose) {
    const auto& q = pose.rotation;
    WideQuaternion wide{Wide(q.w()), widened({q.x(), q.y(), q.z()})};
    const Wide length = sqrt(wide.w * wide.w + wide.v.squaredNorm());
    return {wide.w / length, wide.v / length};
}

WideMatrix cross_matrix(const WideVector& v) {
    WideMatrix m;
    m << Wide(0), -v.z(), v.y(), v.z(), Wide(0), -v.x(), -v.y(), v.x(), Wide(0);
    return m;
}

WideMatrix matrix_of(const WideQuaternion& q) {
    const WideMatrix k = cross_matrix(q.v);
    return WideMatrix::Identity() + k * (2 * q.w) + k * k * Wide(2);
}

/// An even turn. By Rodrigues' formula the matrix at a time is (I + sin K + (1 - cos) K^2) times that of the start.
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
    [[nodiscard]] WideMatrix turned(const Wide& by) const {
        const WideMatrix k = cross_matrix(direction);
        const Wide half = sin(by / 2);
        return WideMatrix::Identity() + k * Wide(sin(by)) + k * k * Wide(2 * half * half);
    }
};

} // namespace

/// The centre has no acceleration, and the angular velocity is constant.
TrueMotion true_velocity(const Pose& start, const Pose& goal, const Eigen::Vector3d& centre) {
    const EvenTurn turn(start, goal);
    const WideVector from = turn.from * widened(centre) + widened(start.translation);
    const WideVector travel =
        turn.turned(turn.angle) * (turn.from * widened(centre)) + widened(goal.translation) - from;
    TrueRates rates;
    rates.turn_rate = double(turn.angle) * outward;
    rates.speed = double(travel.norm()) * outward;
    rates.reference = centre;
    const auto at = [turn, from, travel, centre](double time) {
        const WideMatrix matrix = turn.turned(turn.angle * Wide(time)) * turn.from;
        return TruePose{matrix, from + travel * Wide(time) - matrix * widened(centre)};
    };
    return {at, rates};
}

/// The body's origin is at `arm` from the axis. It runs on a helix with the speed angle * |arm| across the axis and the
/// acceleration angle^2 * |arm|. The arm solves (turn - I) arm = the travel across the axis.
TrueMotion true_twist(const Pose& start, const Pose& goal) {
    const EvenTurn turn(start, goal);
    const WideVector from = widened(start.translation);
    const WideVector travel = widened(goal.translation) - from;
    WideVector along = travel;
    WideVector arm = WideVector::Zero();
    if (turn.angle > 0) {
        along = turn.direction * turn.direction.dot(travel);
        const WideVector across = travel - along;
        const Wide cotangent = cos(turn.angle / 2) / sin(turn.angle / 2);
        arm = (across + turn.direction.cross(across) * cotangent) * Wide(-0.5);
    }
    const double radius = double(arm.norm());
    TrueRates rates;
    rates.turn_rate = double(turn.angle) * outward;
    rates.speed = (double(along.norm()) + rates.turn_rate * radius) * outward;
    rates.acceleration = rates.turn_rate * rates.turn_rate * radius * outward;
    const auto at = [turn, from, along, arm](double time) {
        const WideMatrix since = turn.turned(turn.angle * Wide(time));
        return TruePose{since * turn.from, from + along * Wide(time) + since * arm - arm};
    };
    return {at, rates};
}

/// The reference is that of the inner motion. It stays within D of the outer reference. As seen from the world it has
/// the speed of the frame at D, and its own. Its acceleration is that of the frame at D, its own, and Coriolis' one.
/// The angular velocities add up, and the frame turns the inner one.
TrueMotion true_product(const TrueMotion& outer, const TrueMotion& inner) {
    const TrueRates& a = outer.rates;
    const TrueRates& b = inner.rates;
    const Eigen::Vector3d start = narrowed(inner.at(0)) * b.reference;
    const double distance = ((start - a.reference).norm() + b.speed) * outward + 1e-12 * start.norm();
    TrueRates rates;
    rates.reference = b.reference;
    rates.turn_rate = (a.turn_rate + b.turn_rate) * outward;
    rates.turn_acceleration = (a.turn_acceleration + b.turn_acceleration + a.turn_rate * b.turn_rate) * outward;
    rates.speed = (a.speed + a.turn_rate * distance + b.speed) * outward;
    rates.acceleration = (a.acceleration + (a.turn_rate * a.turn_rate + a.turn_acceleration) * distance +
                          2 * a.turn_rate * b.speed + b.acceleration) *
                         outward;
    const auto at = [outer = outer.at, inner = inner.at](double time) {
        const TruePose frame = outer(time);
        const TruePose body = inner(time);
        return TruePose{frame.turn * body.turn, frame.turn * body.place + frame.place};
    };
    return {at, rates};
}

/// The reference is a resting point P, where the moving reference c starts. It stays within D = the speed of c. Seen
/// from the moving body it is at turn^T (P - c), up to a constant. The product rule bounds both derivatives.
TrueMotion true_inverse(const TrueMotion& motion) {
    const TrueRates& a = motion.rates;
    TrueRates rates;
    rates.reference = narrowed(motion.at(0)) * a.reference;
    const double distance = a.speed * outward + 1e-12 * rates.reference.norm();
    const double turn = a.turn_rate * a.turn_rate + a.turn_acceleration;
    rates.turn_rate = a.turn_rate;
    rates.turn_acceleration = a.turn_acceleration;
    rates.speed = (a.turn_rate * distance + a.speed) * outward;
    rates.acceleration = (turn * distance + 2 * a.turn_rate * a.speed + a.acceleration) * outward;
    const auto at = [at = motion.at](double time) {
        const TruePose pose = at(time);
        const WideMatrix back = pose.turn.transpose();
        return TruePose{back, back * (-pose.place)};
    };
    return {at, rates};
}

Eigen::Isometry3d narrowed(const TruePose& pose) {
    Eigen::Isometry3d result = Eigen::Isometry3d::Identity();
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            result.linear()(i, j) = double(pose.turn(i, j));
    result.translation() = narrowed(pose.place);
    return result;
}

} // namespace chasles::attack
