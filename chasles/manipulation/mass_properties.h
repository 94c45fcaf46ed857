// How a dragged body resists a hand.
#pragma once

#include <Eigen/Core>

namespace chasles {

/// The mass of a body, as a share of its whole mass.
struct MassProperties {
    Eigen::Vector3d centre = Eigen::Vector3d::Zero(); ///< of mass, in the body's frame, mesh unit
    /// Moments of inertia about the centre in the body's frame, per mass (mesh unit squared); symmetric and positive
    /// definite. They say how hard turning is against shifting.
    Eigen::Matrix3d inertia = Eigen::Matrix3d::Identity();
};

} // namespace chasles
