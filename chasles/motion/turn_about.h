// The rotation about an axis, with the same bits on every machine. Eigen's own version calls the C library.
#pragma once

#include "chasles/algebra/sine_cosine.h"

#include <Eigen/Geometry>

namespace chasles {

/// About a direction of length one, by an angle in radians.
inline Eigen::Quaterniond turn_about(const Eigen::Vector3d& direction, double angle) {
    const auto [sine, cosine] = algebra::sine_cosine(angle / 2);
    return {cosine, sine * direction.x(), sine * direction.y(), sine * direction.z()};
}

} // namespace chasles
