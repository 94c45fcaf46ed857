// The spring between a body and the pose that a hand wants: how it pulls, and the energy that it holds.
// Source: docs/derivations/30-dragged-body.md, "The spring".
#pragma once

#include "chasles/manipulation/admissible_twist.h"
#include "chasles/manipulation/mass_properties.h"
#include "chasles/mesh/body.h"
#include "chasles/motion/pose.h"

namespace chasles::manipulation {

/// Those of the solid box around a body. No radius of gyration is below a tenth of the box's diagonal.
MassProperties mass_of_box(const Body& body);

/// Throws InvalidInput "drag: mass: WHY" for numbers that are not finite, and an inertia that is not positive definite.
void check(const MassProperties& mass);

/// The pose after a displacement: linear of the centre, angular as a rotation vector, both in the world.
Pose displaced(const Pose& pose, const Eigen::Vector3d& centre, const Twist& displacement);

/// A spring whose energy is 1/2 (d . d + w . I w), with d the way of the centre to the goal and w the rotation vector
/// of the turn to the goal, seen by the body.
class HandSpring {
public:
    explicit HandSpring(const MassProperties& mass) : mass_(mass) {}

    [[nodiscard]] const Eigen::Vector3d& centre() const { return mass_.centre; } ///< in the body's frame
    /// The metric of the body at a pose, about its centre, in the world.
    [[nodiscard]] Metric metric(const Pose& pose) const;
    /// The displacement that the spring wishes: its force by the metric, about the centre, in the world. To the goal
    /// where all moments of inertia are equal or the turn is small.
    [[nodiscard]] Twist wish(const Pose& pose, const Pose& goal) const;
    /// How much energy the spring loses from one pose to another one.
    [[nodiscard]] double energy_lost(const Pose& from, const Pose& to, const Pose& goal) const;

private:
    MassProperties mass_;
};

} // namespace chasles::manipulation
