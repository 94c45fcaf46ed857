#include "chasles/manipulation/lock.h"

#include "chasles/algebra/arc_tangent.h"
#include "chasles/base/invalid_input.h"
#include "chasles/motion/turn_about.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

#include <cmath>
#include <numbers>

namespace chasles::manipulation {

using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;

namespace {

Quaterniond unit_rotation(const Pose& pose) {
    return Quaterniond(pose.rotation).normalized();
}

/// The part of a vector across a unit direction.
Vector3d across(const Vector3d& vector, const Vector3d& direction) {
    return vector - direction * direction.dot(vector);
}

} // namespace

Lock::Lock(const DragLock& lock, const Pose& start) : kind_(lock.kind), point_(lock.point), start_(start) {
    if (kind_ > DragLockKind::plane)
        throw InvalidInput("drag: lock: the kind is unknown");
    if (!is_free() && !(lock.direction.allFinite() && lock.direction.cwiseAbs().maxCoeff() > 0))
        throw InvalidInput("drag: lock: the direction must be finite and not zero");
    // the greatest of numbers with a NaN among them is any of them
    if (has_line() && !(lock.point.allFinite() && lock.point.cwiseAbs().maxCoeff() <= Pose::largest_length))
        throw InvalidInput("drag: lock: the point must be finite, and no component beyond 1e30");
    if (!is_free())
        direction_ = lock.direction.stableNormalized();
}

/// A basis of the twists of the lock.
Eigen::Matrix<double, 6, Eigen::Dynamic> Lock::twists(const Vector3d& centre) const {
    Twist slide = Twist::Zero(), turn = Twist::Zero(), across_slide = Twist::Zero();
    slide.head<3>() = direction_;
    turn.tail<3>() = direction_;
    if (has_line())
        turn.head<3>() = direction_.cross(centre - point_);
    if (kind_ == DragLockKind::hinge)
        return turn;
    if (kind_ == DragLockKind::slider)
        return slide;
    Eigen::Matrix<double, 6, Eigen::Dynamic> basis(6, kind_ == DragLockKind::plane ? 3 : 2);
    basis.col(0) = turn;
    basis.col(1) = slide;
    if (kind_ == DragLockKind::plane) {
        slide.head<3>() = direction_.unitOrthogonal();
        across_slide.head<3>() = direction_.cross(slide.head<3>());
        basis.col(1) = slide;
        basis.col(2) = across_slide;
    }
    return basis;
}

Metric Lock::projection(const Metric& metric, const Vector3d& centre) const {
    const Eigen::Matrix<double, 6, Eigen::Dynamic> basis = twists(centre);
    const Eigen::MatrixXd weighted = basis.transpose() * metric;
    return basis * (weighted * basis).llt().solve(weighted);
}

/// The pose of the start after a turn.
Pose Lock::turned(double angle) const {
    const Quaterniond turn = turn_about(direction_, angle);
    const Vector3d place = has_line() ? Vector3d(point_ + turn * (start_.translation - point_)) : start_.translation;
    return {place, turn * unit_rotation(start_)};
}

Pose Lock::onto(const Pose& pose) const {
    if (is_free())
        return pose;
    const Quaterniond turn = unit_rotation(pose) * unit_rotation(start_).conjugate();
    const Pose here = turned(turns() ? 2 * algebra::arc_tangent(turn.vec().dot(direction_), turn.w()) : 0);
    const Vector3d way = pose.translation - start_.translation;
    const Vector3d along = direction_ * direction_.dot(way);
    if (kind_ == DragLockKind::hinge)
        return here;
    return {here.translation + (kind_ == DragLockKind::plane ? Vector3d(way - along) : along), here.rotation};
}

/// Of all poses with this turn, the one at which the spring holds the least energy.
Pose Lock::turned_towards(double angle, const HandSpring& spring, const Pose& goal) const {
    const Pose here = turned(angle);
    const Vector3d way = goal.isometry() * spring.centre() - here.isometry() * spring.centre();
    if (kind_ == DragLockKind::hinge)
        return here;
    if (kind_ == DragLockKind::plane)
        return {here.translation + across(way, direction_), here.rotation};
    return {here.translation + direction_ * direction_.dot(way), here.rotation};
}

/// With which the spring turns the body about the line or the normal.
double Lock::torque(double angle, const HandSpring& spring, const Pose& goal) const {
    const Pose here = turned_towards(angle, spring, goal);
    return twists(here.isometry() * spring.centre()).col(0).dot(spring.metric(here) * spring.wish(here, goal));
}

/// The best of some angles, and then by halves to where the torque is zero.
double Lock::best_angle(const HandSpring& spring, const Pose& goal) const {
    constexpr int count = 32;
    constexpr double between = 2 * std::numbers::pi / count;
    double best = 0;
    for (int i = 1; i < count; ++i)
        if (spring.energy_lost(turned_towards(best, spring, goal), turned_towards(i * between, spring, goal), goal) > 0)
            best = i * between;
    double lower = best - between, upper = best + between;
    for (double middle = best; lower < middle && middle < upper; middle = lower + (upper - lower) / 2)
        (torque(middle, spring, goal) > 0 ? lower : upper) = middle;
    return upper;
}

Pose Lock::nearest(const HandSpring& spring, const Pose& goal) const {
    if (is_free())
        return goal;
    return turned_towards(turns() ? best_angle(spring, goal) : 0, spring, goal);
}

} // namespace chasles::manipulation
