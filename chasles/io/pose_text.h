// Poses and points as people write them: numbers separated by blanks or commas.
#pragma once

#include "chasles/motion/pose.h"

#include <span>
#include <string_view>
#include <vector>

namespace chasles::io {

/// Numbers separated by blanks, by commas, or by a comma and blanks; each correctly rounded.
/// Throws InvalidInput for anything else, and for NaN and infinity.
std::vector<double> parse_numbers(std::string_view text);

/// A pose from 3 numbers (x y z), 7 (x y z qw qx qy qz; quaternion of any non-zero length) or 16 (4x4, row by row).
/// Throws InvalidInput for any other count, a zero quaternion, and a matrix that is no rigid displacement.
Pose parse_pose(std::string_view text);

/// The same from numbers.
Pose pose_from_numbers(std::span<const double> numbers);

/// A point or vector from exactly 3 numbers.
Eigen::Vector3d parse_point(std::string_view text);

} // namespace chasles::io
