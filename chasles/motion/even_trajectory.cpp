// Decomposes the displacement between two poses in double-double, then evaluates the even motion in double.
// Source: docs/derivations/25-even-motions.md.
#include "chasles/motion/even_trajectory.h"

#include "chasles/base/invalid_input.h"
#include "chasles/motion/path_ends.h"

#include <algorithm>
#include <cmath>

namespace chasles::motion {

static_assert(Trajectory<EvenTrajectory>);

namespace {

using Scalar = algebra::DoubleDouble;

/// A twist that turns by less has its axis so far away that a point on it is no good reference. In radians.
constexpr double least_turn_for_axis = 0.1;

Vector3<double> in_double(const Vector3<Scalar>& v) {
    return {double(v.x), double(v.y), double(v.z)};
}

Quaternion<Scalar> unit(const Quaternion<Scalar>& q) {
    const Scalar inverse = Scalar(1.0) / sqrt(q.squared_norm());
    return {q.w * inverse, scale(q.v, inverse)};
}

/// The motion without the path of the reference.
EvenMotion<Scalar> turn_between_ends(const RelativeEnds& ends) {
    const Quaternion<Scalar> turn = unit(turn_between(ends.start, ends.goal));
    const Scalar half_sine = sqrt(dot(turn.v, turn.v));
    EvenMotion<Scalar> motion;
    motion.orientation = unit(ends.start.rotation);
    motion.angle = Scalar(2.0) * algebra::angle_of({half_sine, turn.w});
    motion.direction = Scalar(0.0) < half_sine ? scale(turn.v, Scalar(1.0) / half_sine)
                                               : Vector3<Scalar>{Scalar(0.0), Scalar(0.0), Scalar(1.0)};
    return motion;
}

bool turns(const EvenMotion<Scalar>& motion) {
    return Scalar(0.0) < motion.angle;
}

double size_of(const EvenMotion<Scalar>& motion) {
    return norm1(in_double(motion.reference)) + norm1(in_double(motion.start)) + norm1(in_double(motion.travel)) +
           std::min(1.0, double(motion.angle)) * norm1(in_double(motion.arm));
}

RateBounds rates_of(const EvenMotion<double>& motion) {
    const double radius = length(motion.arm);
    return {motion.angle, 0, length(motion.travel) + motion.angle * radius, motion.angle * motion.angle * radius};
}

Pose pose_of(const GeneralPose<double>& pose) {
    const auto& [w, v] = pose.rotation;
    return {{pose.translation.x, pose.translation.y, pose.translation.z}, Eigen::Quaterniond(w, v.x, v.y, v.z)};
}

} // namespace

EvenMotion<double> rounded(const EvenMotion<Scalar>& motion) {
    return {{double(motion.orientation.w), in_double(motion.orientation.v)},
            double(motion.angle),
            in_double(motion.direction),
            in_double(motion.reference),
            in_double(motion.start),
            in_double(motion.travel),
            in_double(motion.arm),
            motion.size};
}

EvenMotion<Scalar> constant_velocity(const RelativeEnds& ends, const Eigen::Vector3d& centre) {
    EvenMotion<Scalar> motion = turn_between_ends(ends);
    motion.reference = vector_in<Scalar>(centre);
    motion.start = rotation_matrix(ends.start.rotation) * motion.reference + ends.start.translation;
    motion.travel = rotation_matrix(ends.goal.rotation) * motion.reference + ends.goal.translation - motion.start;
    motion.size = size_of(motion);
    return motion;
}

EvenMotion<Scalar> constant_twist(const RelativeEnds& ends) {
    EvenMotion<Scalar> motion = turn_between_ends(ends);
    motion.start = ends.start.translation;
    motion.travel = ends.goal.translation - ends.start.translation;
    if (turns(motion)) {
        const Vector3<Scalar> along = scale(motion.direction, dot(motion.direction, motion.travel));
        const Vector3<Scalar> across = motion.travel - along;
        const auto [sine, cosine] = algebra::sine_cosine(Scalar(0.5) * motion.angle);
        const Vector3<Scalar> arm =
            scale(across + scale(cross(motion.direction, across), Scalar(cosine / sine)), Scalar(-0.5));
        motion.travel = along;
        if (double(motion.angle) < least_turn_for_axis) {
            motion.arm = arm;
        } else {
            motion.start = motion.start - arm;
            motion.reference = rotation_matrix(ends.start.rotation).transposed() * (Vector3<Scalar>() - arm);
        }
    }
    motion.size = size_of(motion);
    return motion;
}

EvenWhole::EvenWhole(const MotionEnds& given, const EvenMotion<Scalar>& even)
    : ends(given), motion(even), in_double(rounded(even)), rates(rates_of(in_double)),
      count(static_cast<std::size_t>(std::max(1.0, std::ceil(in_double.angle / most_turn_of_part)))) {}

EvenPiece::EvenPiece(std::shared_ptr<const EvenWhole> whole, std::size_t index)
    : whole_(std::move(whole)), clock_{index, whole_->count}, cubic_(widened(enclosure({0, 1})->cubic)) {}

EnclosureBounds EvenPiece::bounds(const Bracket& part, double rounding) const {
    constexpr double of_times = 0x1p-51;
    const double duration = (part.upper - part.lower) / double(clock_.count) + of_times;
    return enclosure_bounds(whole_->in_double.reference, whole_->rates, duration, rounding, whole_->in_double.size);
}

std::optional<Enclosure<double>> EvenPiece::enclosure(const Bracket& part) const {
    const EvenMotion<double>& motion = whole_->in_double;
    return Enclosure<double>{
        sweep_between_ends<double>({motion.at(time_at(part.lower)), motion.at(time_at(part.upper))},
                                   motion.reference),
        bounds(part, pose_rounding<double>)};
}

std::optional<Enclosure<Scalar>> EvenPiece::refined_enclosure(const Bracket& part) const {
    const EvenMotion<Scalar>& motion = whole_->motion;
    const auto at = [&](double tau) {
        return motion.at((Scalar(double(clock_.index)) + Scalar(tau)) / Scalar(double(clock_.count)));
    };
    return Enclosure<Scalar>{sweep_between_ends<Scalar>({at(part.lower), at(part.upper)}, motion.reference),
                             bounds(part, pose_rounding<Scalar>)};
}

double EvenPiece::tau_tolerance(double time_tolerance) const {
    return std::min(1.0, time_tolerance * double(clock_.count));
}

Pose EvenPiece::pose_at(double tau) const {
    const double time = time_at(tau);
    const MotionEnds& ends = whole_->ends;
    return time <= 0 || time >= 1 ? ends.pose_at_end(time) : ends.in_world(pose_of(whole_->in_double.at(time)), time);
}

EvenTrajectory::EvenTrajectory(Kind kind, const MotionEnds& ends, const Eigen::Vector3d& centre) : ends_(ends) {
    if (!centre.allFinite())
        throw InvalidInput("motion: centre: a number is NaN or infinite");
    if (centre.cwiseAbs().maxCoeff() > Pose::largest_length)
        throw InvalidInput("motion: centre: a number is larger than 1e30");
    const RelativeEnds relative(ends);
    motion_ = kind == Kind::velocity ? constant_velocity(relative, centre) : constant_twist(relative);
}

/// The point stays near the chord of its path, whose ends are known.
PathBall EvenTrajectory::ball_around_path(const Vector3<double>& point) const {
    const PathEnds path(ends_, point);
    const EvenMotion<double> motion = rounded(motion_);
    const RateBounds rates = rates_of(motion);
    const double distance = length(point - motion.reference);
    const double acceleration = rates.acceleration + rates.turn_rate * rates.turn_rate * distance;
    const double speed = rates.speed + rates.turn_rate * distance;
    const double radius = length(path.chord()) / 2 + std::min(acceleration / 8, speed / 2);
    return {path.middle(), radius, motion.size + norm1(point) + size_of_fixed_ends(ends_)};
}

std::optional<CoarseMotion> EvenTrajectory::coarse() const {
    constexpr double quarter_turn = 1.5707963;
    const EvenMotion<double> motion = rounded(motion_);
    if (motion.angle > quarter_turn)
        return std::nullopt;
    const EnclosureBounds bounds =
        enclosure_bounds(motion.reference, rates_of(motion), 1, pose_rounding<double>, motion.size);
    return CoarseMotion{sweep_between_ends<double>({motion.at(0), motion.at(1)}, motion.reference), bounds.deviation,
                        motion.size, bounds.turn_deviation, motion.reference};
}

Pose EvenTrajectory::pose_at(double time) const {
    return time <= 0 || time >= 1 ? ends_.pose_at_end(time) : ends_.in_world(pose_of(rounded(motion_).at(time)), time);
}

} // namespace chasles::motion
