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

/// The turn between two poses.
struct EvenTurn {
    Quaternion<Scalar> quaternion;   ///< of unit length
    double angle;                    ///< in radians, in [0, pi]
    Scalar half_sine;
    Vector3<Scalar> direction{Scalar(0.0), Scalar(0.0), Scalar(1.0)};

    explicit EvenTurn(const RelativeEnds& ends)
        : quaternion(unit(turn_between(ends.start, ends.goal))), angle(turn_angle(quaternion).angle),
          half_sine(sqrt(dot(quaternion.v, quaternion.v))) {
        if (turns())
            direction = scale(quaternion.v, Scalar(1.0) / half_sine);
    }
    [[nodiscard]] bool turns() const { return Scalar(0.0) < half_sine; }
};

/// The motion without the path of the reference.
EvenMotion turn_of(const RelativeEnds& ends, const EvenTurn& turn) {
    const Quaternion<Scalar> orientation = unit(ends.start.rotation);
    EvenMotion motion;
    motion.orientation = {double(orientation.w), in_double(orientation.v)};
    motion.angle = turn.angle;
    motion.direction = in_double(turn.direction);
    return motion;
}

double size_of(const EvenMotion& motion) {
    return norm1(motion.reference) + norm1(motion.start) + norm1(motion.travel) +
           std::min(1.0, motion.angle) * norm1(motion.arm);
}

Pose pose_of(const GeneralPose<double>& pose) {
    const auto& [w, v] = pose.rotation;
    return {{pose.translation.x, pose.translation.y, pose.translation.z}, Eigen::Quaterniond(w, v.x, v.y, v.z)};
}

} // namespace

GeneralPose<double> EvenMotion::at(double time) const {
    const double half = 0.5 * angle * time;
    const double sine = std::sin(half);
    const double cosine = std::cos(half);
    const Quaternion<double> turn{cosine, scale(direction, sine)};
    const Quaternion<double> rotation = turn * orientation;
    const Vector3<double> across = cross(direction, arm);
    const Vector3<double> swing = scale(across, 2 * sine * cosine) + scale(cross(direction, across), 2 * sine * sine);
    const Vector3<double> place = start + scale(travel, time) + swing;
    return {place - rotated(rotation, reference), rotation};
}

RateBounds EvenMotion::rates() const {
    const double radius = length(arm);
    return {angle, 0, length(travel) + angle * radius, angle * angle * radius};
}

EvenMotion constant_velocity(const RelativeEnds& ends, const Vector3<double>& centre) {
    EvenMotion motion = turn_of(ends, EvenTurn(ends));
    const Vector3<Scalar> reference{Scalar(centre.x), Scalar(centre.y), Scalar(centre.z)};
    const Vector3<Scalar> start = rotation_matrix(ends.start.rotation) * reference + ends.start.translation;
    const Vector3<Scalar> goal = rotation_matrix(ends.goal.rotation) * reference + ends.goal.translation;
    motion.reference = centre;
    motion.start = in_double(start);
    motion.travel = in_double(goal - start);
    motion.size = size_of(motion);
    return motion;
}

EvenMotion constant_twist(const RelativeEnds& ends) {
    const EvenTurn turn(ends);
    EvenMotion motion = turn_of(ends, turn);
    const Vector3<Scalar> shift = ends.goal.translation - ends.start.translation;
    motion.start = in_double(ends.start.translation);
    motion.travel = in_double(shift);
    if (turn.turns()) {
        const Vector3<Scalar> along = scale(turn.direction, dot(turn.direction, shift));
        const Vector3<Scalar> across = shift - along;
        const Scalar cotangent = turn.quaternion.w / turn.half_sine;
        const Vector3<Scalar> arm =
            scale(across + scale(cross(turn.direction, across), cotangent), Scalar(-0.5));
        motion.travel = in_double(along);
        if (turn.angle < least_turn_for_axis) {
            motion.arm = in_double(arm);
        } else {
            motion.start = in_double(ends.start.translation - arm);
            motion.reference =
                in_double(rotation_matrix(ends.start.rotation).transposed() * (Vector3<Scalar>() - arm));
        }
    }
    motion.size = size_of(motion);
    return motion;
}

EvenPiece::EvenPiece(const MotionEnds& ends, const EvenMotion& motion, const PieceClock& clock)
    : ends_(ends), motion_(motion), clock_(clock), cubic_(widened(enclosure({0, 1})->cubic)) {}

std::optional<Enclosure> EvenPiece::enclosure(const Bracket& part) const {
    const double start = time_at(part.lower);
    const double goal = time_at(part.upper);
    constexpr double rounding = 0x1p-51; // of both times
    return enclosure_between({motion_.at(start), motion_.at(goal), goal - start + rounding}, motion_.reference,
                             motion_.rates(), motion_.size);
}

double EvenPiece::tau_tolerance(double time_tolerance) const {
    return std::min(1.0, time_tolerance * double(clock_.count));
}

Pose EvenPiece::pose_at(double tau) const {
    const double time = time_at(tau);
    return time <= 0 || time >= 1 ? ends_.pose_at_end(time) : ends_.in_world(pose_of(motion_.at(time)), time);
}

EvenTrajectory::EvenTrajectory(Kind kind, const MotionEnds& ends, const Eigen::Vector3d& centre) : ends_(ends) {
    if (!centre.allFinite())
        throw InvalidInput("motion: centre: a number is NaN or infinite");
    if (centre.cwiseAbs().maxCoeff() > Pose::largest_length)
        throw InvalidInput("motion: centre: a number is larger than 1e30");
    const RelativeEnds relative(ends);
    motion_ = kind == Kind::velocity ? constant_velocity(relative, vector_in<double>(centre))
                                     : constant_twist(relative);
}

EvenTrajectory::Pieces::Pieces(const EvenTrajectory& trajectory)
    : ends_(trajectory.ends_), motion_(trajectory.motion_),
      count_(static_cast<std::size_t>(std::max(1.0, std::ceil(motion_.angle / most_turn_of_part)))) {}

/// The reference stays in a ball around the middle of its way, and the point at one distance from the reference.
PathBall EvenTrajectory::ball_around_path(const Vector3<double>& point) const {
    const PathEnds path(ends_, point);
    const RateBounds rates = motion_.rates();
    const double arm = length(point - motion_.reference);
    const double acceleration = rates.acceleration + rates.turn_rate * rates.turn_rate * arm;
    const double speed = rates.speed + rates.turn_rate * arm;
    const double radius = length(path.chord()) / 2 + std::min(acceleration / 8, speed / 2);
    return {path.middle(), radius, motion_.size + norm1(point) + size_of_fixed_ends(ends_)};
}

std::optional<CoarseMotion> EvenTrajectory::coarse() const {
    constexpr double quarter_turn = 1.5707963;
    if (motion_.angle > quarter_turn)
        return std::nullopt;
    const RateBounds rates = motion_.rates();
    const Enclosure whole = enclosure_between({motion_.at(0), motion_.at(1), 1}, motion_.reference, rates, motion_.size);
    return CoarseMotion{whole.cubic, whole.deviation, motion_.size, whole.turn_deviation, whole.reference};
}

Pose EvenTrajectory::pose_at(double time) const {
    return time <= 0 || time >= 1 ? ends_.pose_at_end(time) : ends_.in_world(pose_of(motion_.at(time)), time);
}

} // namespace chasles::motion
