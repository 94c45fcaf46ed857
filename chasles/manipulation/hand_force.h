// The forces of the contacts of a dragged body against the spring of its hand.
// Source: docs/derivations/30-dragged-body.md, "Friction" and "Forces at their own rate".
#pragma once

#include "chasles/base/parallel_for.h"
#include "chasles/manipulation/slide.h"

#include <memory>

namespace chasles::manipulation {

/// Forces per stiffness of the spring.
struct ContactForces {
    Eigen::VectorXd normal;         ///< one for each contact, not negative
    Eigen::Matrix3Xd friction;      ///< likewise, in the world
    Wrench wrench = Wrench::Zero(); ///< their sum on the body, with the torque about its centre, in the world
};

/// The forces of the contacts that touch, against the whole wish of the spring. What the lock takes is not among them.
ContactForces contact_forces(const SlideProblem& problem);

/// A force and a torque about a body's origin, in the world.
struct ForceAndTorque {
    Eigen::Vector3d force = Eigen::Vector3d::Zero();
    Eigen::Vector3d torque = Eigen::Vector3d::Zero();
};

/// All that the forces at a pose depend on but the goal.
struct Grip {
    HandSpring spring;
    Lock lock;
    double margin = 0;
    double friction = 0;
    double stiffness = 1;
    Pose pose;
    std::vector<ModelledContact> contacts; ///< at the pose

    /// Per stiffness.
    [[nodiscard]] ContactForces forces_at(const Pose& goal) const;
    /// What the contacts push the hand with.
    [[nodiscard]] ForceAndTorque on_hand(const ContactForces& forces) const;
};

/// The grip after the last update. One thread may replace it while others read it.
class SharedGrip {
public:
    void replace(std::shared_ptr<const Grip> grip);
    [[nodiscard]] std::shared_ptr<const Grip> get() const;

private:
    mutable Mutex mutex_; ///< held for the copy of a pointer
    std::shared_ptr<const Grip> grip_;
};

} // namespace chasles::manipulation
