// A motion as a sequence of poses, dense enough that linear interpolation between them looks like the motion.
#pragma once

#include "chasles/chasles.h"

#include <array>

namespace chasles::view {

/// x, y, z, qw, qx, qy, qz. The quaternion has length one, and its dot product with its predecessor is not negative.
using PoseRow = std::array<double, 7>;

/// Neighbours turn by at most this, radians: about a quarter turn. At a half turn every interpolation of quaternions
/// chooses one of two ways by the last bit of a product near zero, and programs choose differently.
constexpr double largest_turn_of_step = 1.6;

/// The turn from one pose to the other one, the shorter way round, in [0, pi].
double turn_between(const Pose& a, const Pose& b);

/// The poses at equal time steps from 0 to 1.
struct SampledPoses {
    std::vector<PoseRow> moving;
    std::vector<PoseRow> fixed; ///< one row if the fixed body does not move
};

SampledPoses sampled_poses(const Motion& motion);

std::vector<PoseRow> pose_rows(const std::vector<Pose>& poses);

} // namespace chasles::view
