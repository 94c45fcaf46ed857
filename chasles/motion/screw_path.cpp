// Decomposes a screw into its rotation and its displacement along and across the axis, in double-double.
// Source: docs/derivations/01-screw-from-two-poses.md.
#include "chasles/motion/screw_path.h"

#include "chasles/algebra/arc_tangent.h"
#include "chasles/motion/unit_quaternion.h"

#include <cmath>
#include <limits>

namespace chasles::motion {

namespace {

using Scalar = algebra::DoubleDouble;
using Vector = Vector3<Scalar>;

/// The quaternion of unit length, in double-double.
Quaternion<Scalar> normalized(const Quaternion<Scalar>& q) {
    const Scalar inverse = Scalar(1.0) / sqrt(q.squared_norm());
    return {q.w * inverse, scale(q.v, inverse)};
}

} // namespace

Pose rounded(const GeneralPose<Scalar>& pose) {
    const Quaternion<Scalar> q = normalized(pose.rotation);
    return Pose(rounded(pose.translation), Eigen::Quaterniond(q.w.high(), q.v.x.high(), q.v.y.high(), q.v.z.high()));
}

/// Tries the fast normalization first. Both ways return the same bits.
Pose normalized(const Pose& pose) {
    FourNumbers numbers;
    for (int i = 0; i < 4; ++i)
        numbers.set(std::size_t(i), pose.rotation.coeffs()[i]);
    const UnitNumbers unit = unit_of_near_unit(numbers);
    if (!unit.is_certain)
        return rounded(exact(pose));
    Pose result = pose;
    for (int i = 0; i < 4; ++i)
        result.rotation.coeffs()[i] = unit.numbers[std::size_t(i)];
    return result;
}

GeneralPose<Scalar> composed(const GeneralPose<Scalar>& outer, const GeneralPose<Scalar>& inner) {
    return {rotation_matrix(outer.rotation) * inner.translation + outer.translation, outer.rotation * inner.rotation};
}

/// At a half turn the cosine is 0, or negative by rounding, and the tangent may be no number.
TurnAngle turn_angle(const Quaternion<Scalar>& turn) {
    const Scalar sine = length(turn.v);
    const double tangent = (sine / turn.w).high();
    const bool is_finite = tangent >= 0 && tangent <= std::numeric_limits<double>::max();
    const double half = is_finite ? algebra::arc_tangent(tangent) : algebra::arc_tangent(sine.high(), turn.w.high());
    return {2 * half, tangent};
}

/// For a pure translation the direction is the direction of the displacement.
ScrewPath::ScrewPath(const GeneralPose<Scalar>& start, const GeneralPose<Scalar>& goal, const Quaternion<Scalar>& turn)
    : start_(start), turn_(normalized(turn)), half_sine_(length(turn_.v)),
      half_angle_(algebra::arc_tangent(half_sine_.high(), turn_.w.high())) {
    const Vector shift = goal.translation - start.translation;
    const bool turns = half_sine_.high() > 0;
    const Vector raw = turns ? turn_.v : shift;
    const Scalar raw_length = turns ? half_sine_ : length(raw);
    if (raw_length.high() > 0)
        direction_ = scale(raw, Scalar(1.0) / raw_length);
    along_ = scale(direction_, dot(direction_, shift));
    if (turns)
        across_ = shift - along_;
}

Pose ScrewPath::at(const ScrewProgress& progress) const {
    const auto [half_sine, half_cosine] = algebra::sine_cosine(progress.turned * half_angle_);
    const Scalar sine(half_sine), cosine(half_cosine);
    const Quaternion<Scalar> turn{cosine, scale(direction_, sine)};
    // The swing of the body's origin, with k the direction and w and v the whole and the partial half angle:
    // sin v ((cos v cot w + sin v) across + (sin v cot w - cos v) k x across); docs/derivations/01, "A pose at a part
    // of the turn".
    Vector swing;
    if (half_sine_.high() > 0) {
        const Scalar cotangent = turn_.w / half_sine_;
        const Vector sideways = cross(direction_, across_);
        const Scalar straight = sine * (cosine * cotangent + sine);
        const Scalar across = sine * (sine * cotangent - cosine);
        swing = scale(across_, straight) + scale(sideways, across);
    }
    const Vector position = start_.translation + swing + scale(along_, Scalar(progress.slid));
    return rounded({position, turn * start_.rotation});
}

ScrewNumbers ScrewPath::numbers() const {
    ScrewNumbers numbers;
    numbers.angle = 2 * half_angle_;
    numbers.half_tangent = (half_sine_ / turn_.w).high();
    numbers.slide = dot(along_, direction_).high();
    numbers.axis_direction = rounded(direction_);
    if (numbers.axis_direction.isZero())
        numbers.axis_direction = Eigen::Vector3d::UnitZ();
    Vector centre; // of the rotation, relative to the body's origin: (across + k x across cot w) / 2
    if (half_sine_.high() > 0) {
        const Scalar cotangent = turn_.w / half_sine_;
        centre = scale(across_ + scale(cross(direction_, across_), cotangent), Scalar(0.5));
    }
    numbers.axis_point = rounded(start_.translation + centre);
    return numbers;
}

Pose screw_pose(const GeneralPose<Scalar>& start, const GeneralPose<Scalar>& goal, const ScrewProgress& progress) {
    if (progress.turned <= 0 && progress.slid <= 0)
        return rounded(start);
    if (progress.turned >= 1 && progress.slid >= 1)
        return rounded(goal);
    return ScrewPath(start, goal).at(progress);
}

} // namespace chasles::motion
