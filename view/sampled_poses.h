// A motion as poses in a row, close enough that a straight step from one to the next cannot be told from it.
#pragma once

#include "chasles/chasles.h"

#include <array>

namespace chasles::view {

/// x, y, z, qw, qx, qy, qz; the quaternion has length one and keeps to the side of the one before.
using PoseRow = std::array<double, 7>;

/// At equal times from 0 to 1. Of the very motion that a query with this `max_turn` answers for.
struct SampledPoses {
    std::vector<PoseRow> moving;
    std::vector<PoseRow> fixed; ///< one row if it stands still
};

SampledPoses sampled_poses(const Motion& motion, double max_turn);

} // namespace chasles::view
