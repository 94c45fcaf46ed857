// Decomposes the displacement between two poses in double-double, then evaluates the even motion in double.
// Source: docs/derivations/25-even-motions.md.
#include "chasles/motion/even_trajectory.h"

#include "chasles/algebra/arc_tangent.h"
#include "chasles/motion/axis_motion.h"
#include "chasles/motion/path_ends.h"

#include <algorithm>
#include <cmath>

namespace chasles::motion {

static_assert(Trajectory<EvenTrajectory>);

namespace {

using Scalar = algebra::DoubleDouble;
using Exact = algebra::ExactNumber;

/// A twist that turns by less has its axis so far away that a point on it is no good reference. In radians.
constexpr double least_turn_for_axis = 0.1;
constexpr double never_on_axis = 4;
/// Just below a half turn: there, rounding in double would decide which way round the body turns.
constexpr double certain_turn = 3.1415926;

template <class S>
Quaternion<S> unit(const Quaternion<S>& q) {
    using std::sqrt;
    const S inverse = S(1.0) / sqrt(q.squared_norm());
    return {q.w * inverse, scale(q.v, inverse)};
}

template <class S>
S product_sum(const Quaternion<S>& a, const Quaternion<S>& b) {
    return a.w * b.w + dot(a.v, b.v);
}

/// The quaternion or its negative: the one nearer to `from`.
template <class S>
Quaternion<S> shorter_way(const Quaternion<S>& from, const Quaternion<S>& to) {
    return product_sum(from, to) < S(0.0) ? Quaternion<S>{S(S(0.0) - to.w), Vector3<S>() - to.v} : to;
}

/// The quaternion times the power of two that brings its length next to that of another one. Exact.
template <class S>
Quaternion<S> as_long_as(const Quaternion<S>& other, const Quaternion<S>& q) {
    const auto exponent = [](const Quaternion<S>& x) { return std::ilogb(double(x.squared_norm())); };
    const S factor(std::ldexp(1.0, (exponent(other) - exponent(q)) / 2));
    return {q.w * factor, scale(q.v, factor)};
}

/// The motion without the path of the reference. The turn is made from the difference of both quaternions, whose
/// relative rounding is small however little the body turns. Were one far longer, the other would be lost in it.
template <class S>
EvenMotion<S> turn_between_ends(const GeneralPose<S>& from, const GeneralPose<S>& to) {
    const Quaternion<S>& a = from.rotation;
    const Quaternion<S> b = shorter_way(a, as_long_as(a, to.rotation));
    const Quaternion<S> difference{b.w - a.w, b.v - a.v};
    const Quaternion<S> turn = unit(Quaternion<S>{product_sum(a, b), (difference * a.conjugate()).v});
    const S half_sine = length(turn.v);
    EvenMotion<S> motion;
    motion.orientation = unit(a);
    motion.angle = S(2.0) * algebra::angle_of(algebra::SineCosine<S>{half_sine, turn.w});
    motion.direction = S(0.0) < half_sine ? scale(turn.v, S(S(1.0) / half_sine)) : Vector3<S>{S(0.0), S(0.0), S(1.0)};
    return motion;
}

double size_of(const Vector3<double>& v) {
    return norm1(v);
}
double size_of(const Vector3<Scalar>& v) {
    return norm1(in_double(v));
}
template <class S>
double size_of(const EvenMotion<S>& motion) {
    return size_of(motion.reference) + size_of(motion.start) + size_of(motion.travel) +
           std::min(1.0, double(motion.angle)) * size_of(motion.arm);
}

/// Slerp, the shorter way round, while the body point `centre` moves on a straight line.
template <class S>
EvenMotion<S> constant_velocity(const GeneralPose<S>& from, const GeneralPose<S>& to, const Vector3<S>& centre) {
    EvenMotion<S> motion = turn_between_ends(from, to);
    motion.reference = centre;
    motion.start = placed(from, centre);
    motion.travel = placed(to, centre) - motion.start;
    motion.size = size_of(motion);
    return motion;
}

/// Even turn about, and even slide along, the axis of the screw between both poses: a uniform helix.
/// The reference is on the axis if the body turns by at least `least_turn`.
template <class S>
EvenMotion<S> constant_twist(const GeneralPose<S>& from, const GeneralPose<S>& to, double least_turn) {
    EvenMotion<S> motion = turn_between_ends(from, to);
    motion.start = from.translation;
    motion.travel = to.translation - from.translation;
    if (S(0.0) < motion.angle) {
        const Vector3<S> along = scale(motion.direction, dot(motion.direction, motion.travel));
        const Vector3<S> across = motion.travel - along;
        const auto [sine, cosine] = algebra::sine_cosine(S(S(0.5) * motion.angle));
        const Vector3<S> arm = scale(across + scale(cross(motion.direction, across), S(cosine / sine)), S(-0.5));
        motion.travel = along;
        if (double(motion.angle) < least_turn) {
            motion.arm = arm;
        } else {
            motion.start = motion.start - arm;
            motion.reference = rotated(from.rotation.conjugate(), Vector3<S>() - arm);
        }
    }
    motion.size = size_of(motion);
    return motion;
}

template <class S>
EvenMotion<S> even_motion(EvenKind kind, const Pose& start, const Pose& goal, const Eigen::Vector3d& centre,
                          double least_turn) {
    const auto from = pose_in<S>(start);
    const auto to = pose_in<S>(goal);
    return kind == EvenKind::velocity ? constant_velocity(from, to, vector_in<S>(centre))
                                      : constant_twist(from, to, least_turn);
}

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

RateBounds rates_of(const EvenMotion<double>& motion) {
    const double radius = length(motion.arm);
    return {motion.angle, 0, length(motion.travel) + motion.angle * radius, motion.angle * motion.angle * radius};
}

} // namespace

EvenFrame::EvenFrame(EvenKind kind, const Pose& start, const Pose& goal, const Eigen::Vector3d& centre,
                     bool may_be_on_axis)
    : start_(start), goal_(goal), centre_(centre),
      motion_(even_motion<double>(kind, start, goal, centre, may_be_on_axis ? least_turn_for_axis : never_on_axis)),
      kind_(kind), may_be_on_axis_(may_be_on_axis) {
    if (motion_.angle > certain_turn)
        motion_ = rounded(refined());
    rates_ = rates_of(motion_);
}

/// With the same point as reference as in double, where a least turn may be none.
const EvenMotion<Scalar>& EvenFrame::refined() const {
    std::call_once(is_made_, [this] {
        const bool is_on_axis = may_be_on_axis_ && motion_.angle >= least_turn_for_axis;
        const double least_turn = is_on_axis ? 0 : never_on_axis;
        refined_ = std::make_unique<EvenMotion<Wide>>(even_motion<Scalar>(kind_, start_, goal_, centre_, least_turn));
    });
    return *refined_;
}

GeneralPose<double> EvenFrame::at_end(bool is_goal) const {
    const GeneralPose<double> end = pose_in<double>(is_goal ? goal_ : start_);
    const Quaternion<double>& start = motion_.orientation;
    return {end.translation, is_goal ? unit(shorter_way(start, end.rotation)) : start};
}

RateExpansion EvenFrame::expansion(const Bracket& times) const {
    const EvenMotion<double>& motion = motion_;
    const auto pose = motion.at(middle_of(times));
    RateExpansion expansion{.pose = pose, .reference = placed(pose, motion.reference)};
    const Vector3<double> arm = rotated(pose.rotation * motion.orientation.conjugate(), motion.arm);
    expansion.turn_rate = scale(motion.direction, motion.angle);
    const Vector3<double> swing = cross(expansion.turn_rate, arm);
    expansion.velocity = motion.travel + swing;
    expansion.acceleration = cross(expansion.turn_rate, swing);
    expansion.bounds = expansion.sums = rates_;
    expansion.turn_jerk = 0;
    expansion.jerk = motion.angle * rates_.acceleration;
    return expansion;
}

/// A point that the motion does not move; empty where it moves all, or slides along its axis.
std::optional<ScaledVector> EvenFrame::resting_point(const ExactTurn& turn) const {
    const auto& [w, v] = turn.rotation;
    const Vector3<Exact> start = pose_in<Exact>(start_).translation;
    if (kind_ == EvenKind::velocity) {
        const Vector3<Exact> centre = vector_in<Exact>(centre_);
        const ScaledVector before = ExactPose(start_).placed({centre}), after = ExactPose(goal_).placed({centre});
        return (after - before).is_zero() ? std::optional(before) : std::nullopt;
    }
    if (dot(v, turn.shift).sign() != 0)
        return std::nullopt;
    const Exact square = dot(v, v), twice = square + square;
    return ScaledVector{scale(start, twice) + scale(turn.shift, square) + scale(cross(v, turn.shift), w), twice};
}

/// A turn about an axis without a slide, or a slide without a turn. Most motions are neither, as a look at the numbers
/// in double tells.
std::vector<AxisSection> EvenFrame::axis_sections() const {
    constexpr double rounding = 1e-12;
    const bool turns = motion_.angle > rounding;
    if (turns && length(motion_.travel) > rounding * motion_.size)
        return {};
    const Quaternion<Exact> from = pose_in<Exact>(start_).rotation, to = pose_in<Exact>(goal_).rotation;
    ExactTurn turn{to * from.conjugate(), pose_in<Exact>(goal_).translation - pose_in<Exact>(start_).translation};
    const Vector3<double>& way = motion_.direction;
    const Vector3<Exact> forwards{way.x, way.y, way.z};
    const int sign = turn.rotation.w.sign() != 0 ? turn.rotation.w.sign() : dot(turn.rotation.v, forwards).sign();
    if (sign < 0)
        turn.rotation = {-turn.rotation.w, Vector3<Exact>() - turn.rotation.v};
    AxisMotion motion;
    motion.base = ExactPose(start_);
    motion.direction = {turns ? turn.rotation.v : turn.shift};
    motion.kind = turns ? AxisMotion::Kind::turn : AxisMotion::Kind::slide;
    motion.goal = {1.0, 1.0};
    if (turns) {
        const std::optional<ScaledVector> point = resting_point(turn);
        if (!point)
            return {};
        motion.point = *point;
        motion.value = TimePolynomial(std::vector<Wide>{Wide(0.0), refined().angle});
        motion.goal->cosine = turn.rotation.w;
    } else if (!ScaledVector{turn.rotation.v}.is_zero()) {
        return {};
    } else if (motion.direction.is_zero()) {
        motion.kind = AxisMotion::Kind::rest;
    }
    return {{{0, 1}, motion}};
}

EvenMotion<Scalar> EvenFrame::turn_between(const Pose& from, const Pose& to) {
    return turn_between_ends(exact(from), exact(to));
}

SharedFrame velocity_frame(const Pose& start, const Pose& goal, const Eigen::Vector3d& centre) {
    return std::make_shared<const EvenFrame>(EvenKind::velocity, start, goal, centre, false);
}

SharedFrame twist_frame(const Pose& start, const Pose& goal) {
    return std::make_shared<const EvenFrame>(EvenKind::twist, start, goal, Eigen::Vector3d::Zero(), false);
}

bool EvenFrame::add_links(ChainLinks& chain, bool is_inverse) const {
    using enum ChainLink::Kind;
    const ChainLink::Kind kind = kind_ == EvenKind::velocity ? velocity : twist;
    return chain.add({kind, is_inverse, centre_, {start_, goal_}, {}}, {0, 1});
}

EvenTrajectory::EvenTrajectory(Kind kind, const MotionEnds& ends, const Eigen::Vector3d& centre)
    : ends_(ends), centre_(checked_centre(centre)), kind_(kind) {}

SharedFrame EvenTrajectory::frame() const {
    return std::make_shared<const EvenFrame>(kind_, ends_.start, ends_.goal, centre_, true);
}

EvenMotion<double> EvenTrajectory::numbers() const {
    return even_motion<double>(kind_, ends_.start, ends_.goal, centre_, least_turn_for_axis);
}

/// The point stays near the chord of its path, whose ends are known.
PathBall EvenTrajectory::ball_around_path(const Vector3<double>& point) const {
    const PathEnds path(ends_, point);
    const EvenMotion<double> motion = numbers();
    const RateBounds rates = rates_of(motion);
    const double distance = length(point - motion.reference);
    const double radius = length(path.chord()) / 2 + deviation_from_straight(rates, distance, 1);
    return {path.middle(), radius, motion.size + norm1(point)};
}

std::optional<CoarseMotion> EvenTrajectory::coarse(std::size_t /*part*/) const {
    constexpr double quarter_turn = 1.5707963;
    const EvenMotion<double> motion = numbers();
    if (motion.angle > quarter_turn)
        return std::nullopt;
    const EnclosureBounds bounds =
        enclosure_bounds(motion.reference, rates_of(motion), 1, pose_rounding<double>, motion.size);
    const PartEnds<double> ends{pose_in<double>(ends_.start), pose_in<double>(ends_.goal)};
    return CoarseMotion{sweep_between_ends(ends, motion.reference),
                        bounds.deviation,
                        motion.size,
                        bounds.turn_deviation,
                        motion.reference,
                        bounds.rounding,
                        bounds.turn_rounding};
}

SmoothPieces EvenTrajectory::pieces() const {
    const SharedFrame moving = frame();
    return {SmoothMotion::of_one(moving), std::make_shared<const Sections>(moving)};
}

SharedTrajectory EvenTrajectory::with_goal(const Pose& goal_in_world) const {
    return std::make_shared<const ErasedTrajectory<EvenTrajectory>>(
        EvenTrajectory(kind_, ends_.with_goal(goal_in_world), centre_));
}

SharedTrajectory EvenTrajectory::reversed() const {
    return std::make_shared<const ErasedTrajectory<EvenTrajectory>>(EvenTrajectory(kind_, ends_.reversed(), centre_));
}

Pose EvenTrajectory::pose_at(double time) const {
    return time <= 0 || time >= 1 ? ends_.pose_at_end(time) : public_pose(frame()->at(time));
}

} // namespace chasles::motion
