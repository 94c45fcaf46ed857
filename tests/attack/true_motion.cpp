#include "tests/attack/true_motion.h"

#include "tests/attack/wide_turn.h"

#include <algorithm>

namespace chasles::attack {

/// The centre has no acceleration, and the angular velocity is constant.
TrueMotion true_velocity(const Pose& start, const Pose& goal, const Eigen::Vector3d& centre) {
    const EvenTurn turn(start, goal);
    const WideVector from = turn.from * widened(centre) + widened(start.translation);
    const WideVector travel =
        turn.turned(turn.angle) * (turn.from * widened(centre)) + widened(goal.translation) - from;
    TrueRates rates;
    rates.turn_rate = double(turn.angle) * bound_rounding;
    rates.speed = double(travel.norm()) * bound_rounding;
    const auto at = [turn, from, travel, centre](const Wide& time) {
        const WideMatrix matrix = turn.turned(turn.angle * time) * turn.from;
        return TruePose{matrix, from + travel * time - matrix * widened(centre)};
    };
    return {at, centre, {{0, 1, rates}}, centre.norm(), 1};
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
    rates.turn_rate = double(turn.angle) * bound_rounding;
    rates.speed = (double(along.norm()) + rates.turn_rate * radius) * bound_rounding;
    rates.acceleration = rates.turn_rate * rates.turn_rate * radius * bound_rounding;
    const auto at = [turn, from, along, arm](const Wide& time) {
        const WideMatrix since = turn.turned(turn.angle * time);
        return TruePose{since * turn.from, from + along * time + since * arm - arm};
    };
    return {at, Eigen::Vector3d::Zero(), {{0, 1, rates}}, 0, 1};
}

namespace {

/// The parts of two motions, divided where one of them has an end.
std::vector<std::array<TruePart, 2>> divided(const std::vector<TruePart>& a, const std::vector<TruePart>& b) {
    std::vector<std::array<TruePart, 2>> parts;
    double from = 0;
    for (std::size_t i = 0, j = 0; i < a.size() && j < b.size();) {
        const double to = std::min(a[i].to, b[j].to);
        parts.push_back({TruePart{from, to, a[i].rates}, TruePart{from, to, b[j].rates}});
        from = to;
        i += a[i].to == to ? 1 : 0;
        j += b[j].to == to ? 1 : 0;
    }
    return parts;
}

/// How far from a point the reference of a motion gets during a part of time.
double greatest_distance(const TrueMotion& motion, const TruePart& part, const Eigen::Vector3d& point) {
    const TruePose pose = motion.at(part.middle());
    const WideVector place = pose.turn * widened(motion.reference) + pose.place;
    return (double((place - widened(point)).norm()) + part.rates.speed * part.half()) * bound_rounding;
}

} // namespace

/// The reference is that of the inner motion. It stays within D of the outer reference. As seen from the world it has
/// the speed of the frame at D, and its own. Its acceleration is that of the frame at D, its own, and Coriolis' one.
/// The angular velocities add up, and the frame turns the inner one.
TrueMotion true_product(const TrueMotion& outer, const TrueMotion& inner) {
    TrueMotion product;
    product.reference = inner.reference;
    product.size = outer.size + inner.size + outer.reference.norm() + inner.reference.norm();
    product.elements = outer.elements + inner.elements;
    for (const auto& [frame, body] : divided(outer.parts, inner.parts)) {
        const TrueRates& a = frame.rates;
        const TrueRates& b = body.rates;
        const double distance = greatest_distance(inner, body, outer.reference);
        TrueRates rates;
        rates.turn_rate = (a.turn_rate + b.turn_rate) * bound_rounding;
        rates.turn_acceleration =
            (a.turn_acceleration + b.turn_acceleration + a.turn_rate * b.turn_rate) * bound_rounding;
        rates.speed = (a.speed + a.turn_rate * distance + b.speed) * bound_rounding;
        rates.acceleration = (a.acceleration + (a.turn_rate * a.turn_rate + a.turn_acceleration) * distance +
                              2 * a.turn_rate * b.speed + b.acceleration) *
                             bound_rounding;
        product.parts.push_back({frame.from, frame.to, rates});
    }
    product.at = [outer = outer.at, inner = inner.at](const Wide& time) {
        const TruePose frame = outer(time);
        const TruePose body = inner(time);
        return TruePose{frame.turn * body.turn, frame.turn * body.place + frame.place};
    };
    return product;
}

/// The reference is a resting point P, where the moving reference c starts. c stays within D of it. Seen from the
/// moving body, P is at turn^T (P - c), up to a constant. The product rule bounds both derivatives.
TrueMotion true_inverse(const TrueMotion& motion) {
    TrueMotion inverse;
    inverse.reference = narrowed(motion.at(0)) * motion.reference;
    inverse.size = motion.size + motion.reference.norm();
    inverse.elements = motion.elements;
    for (const TruePart& part : motion.parts) {
        const TrueRates& a = part.rates;
        const double distance = greatest_distance(motion, part, inverse.reference);
        TrueRates rates = a;
        rates.speed = (a.turn_rate * distance + a.speed) * bound_rounding;
        rates.acceleration = ((a.turn_rate * a.turn_rate + a.turn_acceleration) * distance + 2 * a.turn_rate * a.speed +
                              a.acceleration) *
                             bound_rounding;
        inverse.parts.push_back({part.from, part.to, rates});
    }
    inverse.at = [at = motion.at](const Wide& time) {
        const TruePose pose = at(time);
        const WideMatrix back = pose.turn.transpose();
        return TruePose{back, back * (-pose.place)};
    };
    return inverse;
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
