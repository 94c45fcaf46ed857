// A turn between two directions. Eigen's takes the compiler nine seconds in each file, for a singular value
// decomposition.
#pragma once

#include <Eigen/Geometry>
#include <cmath>

namespace chasles::test {

/// Turns one direction to another on the shortest way. If they are opposite, about the x axis where this is across.
inline Eigen::Quaterniond turn_to(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
    Eigen::Vector3d axis = from.cross(to);
    const double sine = axis.norm();
    if (sine == 0)
        axis = from.cross(from.y() == 0 && from.z() == 0 ? Eigen::Vector3d::UnitZ() : Eigen::Vector3d::UnitX())
                   .cross(from);
    return Eigen::Quaterniond(Eigen::AngleAxisd(std::atan2(sine, from.dot(to)), axis.normalized()));
}

} // namespace chasles::test
