// How the configurations of a path depend on its knots. Source: docs/derivations/41-gradients.md, "Robots".
#pragma once

#include "chasles/robot/joint_path.h"

#include <span>
#include <vector>

namespace chasles::robot {

/// A knot and how much it counts.
struct KnotWeight {
    std::size_t knot;
    double weight;
};

/// The derivative of each variable by its values at the knots, at a time of a segment in [0, 1]: the same for all
/// variables but quaternions. Knots of weight 0 are left out, and so are those of a natural spline that count for less
/// than rounding. Throws InvalidInput for a path without knots.
std::vector<KnotWeight> knot_weights(const JointPath& path, std::size_t segment, double time);

/// The velocities at the knots of the natural cubic spline.
std::vector<Configuration> natural_velocities(std::span<const double> times, std::span<const Configuration> positions);

} // namespace chasles::robot
