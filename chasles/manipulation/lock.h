// The poses and the twists that a lock leaves to a dragged body.
// Source: docs/derivations/30-dragged-body.md, "Locks".
#pragma once

#include "chasles/manipulation/drag_lock.h"
#include "chasles/manipulation/hand_spring.h"

namespace chasles::manipulation {

class Lock {
public:
    Lock() = default; ///< free
    /// For a body that is at `start`. Throws InvalidInput "drag: lock: WHY" for a direction or a point that cannot be
    /// used.
    Lock(const DragLock& lock, const Pose& start);

    [[nodiscard]] bool is_free() const { return kind_ == DragLockKind::free; }
    /// Projects twists about the centre, given in the world, on those that the lock leaves, orthogonally in the metric.
    [[nodiscard]] Metric projection(const Metric& metric, const Eigen::Vector3d& centre) const;
    /// The pose of the lock with the turn and the slide of a pose; exact up to one rounding, however the pose came
    /// about.
    [[nodiscard]] Pose onto(const Pose& pose) const;
    /// The pose of the lock at which the spring to a goal holds the least energy. The same for the same goal, bit for
    /// bit.
    [[nodiscard]] Pose nearest(const HandSpring& spring, const Pose& goal) const;

private:
    [[nodiscard]] bool turns() const { return kind_ != DragLockKind::slider; }
    [[nodiscard]] bool has_line() const { return kind_ == DragLockKind::hinge || kind_ == DragLockKind::cylinder; }
    [[nodiscard]] Eigen::Matrix<double, 6, Eigen::Dynamic> twists(const Eigen::Vector3d& centre) const;
    [[nodiscard]] Pose turned(double angle) const;
    [[nodiscard]] Pose turned_towards(double angle, const HandSpring& spring, const Pose& goal) const;
    [[nodiscard]] double torque(double angle, const HandSpring& spring, const Pose& goal) const;
    [[nodiscard]] double best_angle(const HandSpring& spring, const Pose& goal) const;

    DragLockKind kind_ = DragLockKind::free;
    Eigen::Vector3d direction_ = Eigen::Vector3d::UnitZ(); ///< unit
    Eigen::Vector3d point_ = Eigen::Vector3d::Zero();
    Pose start_;
};

} // namespace chasles::manipulation
