// Rigid bodies with mass, for the examples: free ones, ones on a hinge, and ones that stay where they are.
#pragma once

#include <chasles/chasles.h>
#include <optional>

namespace chasles::examples {

/// A line in the world about which a body turns.
struct Hinge {
    Eigen::Vector3d point;
    Eigen::Vector3d direction; ///< unit
};

/// What an impulse changes.
struct Velocity {
    Eigen::Vector3d linear = Eigen::Vector3d::Zero();  ///< of the centre of mass
    Eigen::Vector3d angular = Eigen::Vector3d::Zero(); ///< radians in a unit of time
};

/// The state of a body. Lengths, times and masses are in any units that fit together.
struct RigidBody {
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    Velocity velocity = {};
    Eigen::Vector3d centre = Eigen::Vector3d::Zero();  ///< of mass, in the frame of the body
    double mass = 0;                                   ///< 0: the body stays where it is
    Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero(); ///< about the centre, in the frame of the body
    std::optional<Hinge> hinge = {};

    [[nodiscard]] bool moves() const { return mass > 0; }
    [[nodiscard]] Eigen::Vector3d centre_in_world() const { return pose * centre; }
    [[nodiscard]] Eigen::Matrix3d inertia_in_world() const;
    [[nodiscard]] Eigen::Vector3d velocity_at(const Eigen::Vector3d& point) const;
    /// The change of the velocity by an impulse at a point of the world.
    [[nodiscard]] Velocity answer_to(const Eigen::Vector3d& impulse, const Eigen::Vector3d& point) const;
    /// Gives the body another pose at the same angular velocity.
    void place(const Eigen::Isometry3d& at);
    void push(const Eigen::Vector3d& impulse, const Eigen::Vector3d& point);
    [[nodiscard]] double kinetic_energy() const;
    /// The motion from the present pose at the present velocity.
    [[nodiscard]] Motion flight(double duration) const;
};

/// A body of even density: its mass, centre and inertia by integrals over its surface, which must be closed and
/// oriented outwards.
RigidBody solid(const Polyhedron& shape, double density);

} // namespace chasles::examples
