#include "chasles/motion/screw_pose.h"

#include <cmath>

namespace chasles::motion {

namespace {

using Scalar = algebra::DoubleDouble;
using Vector = Vector3<Scalar>;

Eigen::Vector3d rounded(const Vector& v) {
    return {v.x.high(), v.y.high(), v.z.high()};
}

Scalar length(const Vector& v) {
    return sqrt(dot(v, v));
}

/// The displacement of the body's origin along and across the axis, and the turn with length one.
struct Parts {
    Quaternion<Scalar> turn;
    Scalar half_sine;
    Vector direction; ///< unit; of the shift if nothing turns; zero if nothing moves
    Vector along;
    Vector across;
};

Quaternion<Scalar> normalized(const Quaternion<Scalar>& q) {
    const Scalar inverse = Scalar(1.0) / sqrt(q.squared_norm());
    return {q.w * inverse, scale(q.v, inverse)};
}

Parts parts_of(const GeneralPose<Scalar>& start, const GeneralPose<Scalar>& goal) {
    Parts parts;
    parts.turn = normalized(turn_between(start, goal));
    parts.half_sine = length(parts.turn.v);
    const Vector shift = goal.translation - start.translation;
    const Vector raw = parts.half_sine.high() > 0 ? parts.turn.v : shift;
    const Scalar raw_length = length(raw);
    if (raw_length.high() > 0)
        parts.direction = scale(raw, Scalar(1.0) / raw_length);
    parts.along = scale(parts.direction, dot(parts.direction, shift));
    parts.across = parts.half_sine.high() > 0 ? shift - parts.along : Vector();
    return parts;
}

} // namespace

Pose rounded(const GeneralPose<Scalar>& pose) {
    const Quaternion<Scalar> q = normalized(pose.rotation);
    return Pose(rounded(pose.translation), Eigen::Quaterniond(q.w.high(), q.v.x.high(), q.v.y.high(), q.v.z.high()));
}

GeneralPose<Scalar> composed(const GeneralPose<Scalar>& outer, const GeneralPose<Scalar>& inner) {
    return {rotation_matrix(outer.rotation) * inner.translation + outer.translation, outer.rotation * inner.rotation};
}

GeneralPose<Scalar> seen_from(const GeneralPose<Scalar>& frame, const GeneralPose<Scalar>& pose) {
    const Quaternion<Scalar> back = frame.rotation.conjugate();
    return {rotation_matrix(back) * (pose.translation - frame.translation), back * pose.rotation};
}

double turn_angle(const GeneralPose<Scalar>& start, const GeneralPose<Scalar>& goal) {
    const Quaternion<Scalar> turn = turn_between(start, goal);
    return 2 * std::atan2(length(turn.v).high(), turn.w.high());
}

Pose screw_pose(const GeneralPose<Scalar>& start, const GeneralPose<Scalar>& goal, const ScrewProgress& progress) {
    if (progress.turned <= 0 && progress.slid <= 0)
        return rounded(start);
    if (progress.turned >= 1 && progress.slid >= 1)
        return rounded(goal);
    const Parts parts = parts_of(start, goal);
    const double half = progress.turned * std::atan2(parts.half_sine.high(), parts.turn.w.high());
    const Scalar sine(std::sin(half));
    const Scalar cosine(std::cos(half));
    const Quaternion<Scalar> turn{cosine, scale(parts.direction, sine)};
    // With k the direction, w and v the whole and the partial half angle: the origin swings by
    // sin v (sin v, cos v) over (across, k x across) turned by cot w; docs/derivations/01, last section.
    Vector swing;
    if (parts.half_sine.high() > 0) {
        const Scalar cotangent = parts.turn.w / parts.half_sine;
        const Vector sideways = cross(parts.direction, parts.across);
        const Scalar straight = sine * (cosine * cotangent + sine);
        const Scalar across = sine * (sine * cotangent - cosine);
        swing = scale(parts.across, straight) + scale(sideways, across);
    }
    const Vector position = start.translation + swing + scale(parts.along, Scalar(progress.slid));
    return rounded({position, turn * start.rotation});
}

ScrewNumbers screw_numbers(const GeneralPose<Scalar>& start, const GeneralPose<Scalar>& goal) {
    const Parts parts = parts_of(start, goal);
    ScrewNumbers numbers;
    numbers.angle = 2 * std::atan2(parts.half_sine.high(), parts.turn.w.high());
    numbers.half_tangent = (parts.half_sine / parts.turn.w).high();
    numbers.slide = dot(parts.along, parts.direction).high();
    numbers.axis_direction = rounded(parts.direction);
    if (numbers.axis_direction.isZero())
        numbers.axis_direction = Eigen::Vector3d::UnitZ();
    Vector centre; // of the swing, relative to the body's origin: (across + k x across cot w) / 2
    if (parts.half_sine.high() > 0) {
        const Scalar cotangent = parts.turn.w / parts.half_sine;
        centre = scale(parts.across + scale(cross(parts.direction, parts.across), cotangent), Scalar(0.5));
    }
    numbers.axis_point = rounded(start.translation + centre);
    return numbers;
}

} // namespace chasles::motion
