// Parts of segments of paths. Source: docs/derivations/42-several-robots.md, "Parts of segments".
#pragma once

#include "chasles/robot/joint_path.h"

#include <span>

namespace chasles::robot {

/// The segment between two stamps within it: begin <= lower < upper <= end. Each coefficient is the exact one, rounded
/// once to double-double. `quaternions` are those of the path: their parts are even turns between their orientations at
/// both stamps, which have errors of at most 2^-96.
JointPath::Segment part_of(const JointPath::Segment& segment, double lower, double upper,
                           std::span<const std::size_t> quaternions);

/// At rest where the segment begins, or where it ends: coefficients of power 0 only.
JointPath::Segment rest_at_begin(const JointPath::Segment& segment);
JointPath::Segment rest_at_end(const JointPath::Segment& segment);

} // namespace chasles::robot
