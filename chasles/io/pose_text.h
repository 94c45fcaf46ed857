// Reads poses and points from text: numbers separated by blanks or commas.
// Numbers are correctly rounded and do not depend on the locale.
#pragma once

#include "chasles/motion/pose.h"

#include <span>
#include <string_view>
#include <vector>

namespace chasles::io {

/// Numbers separated by blanks, by commas, or by a comma and blanks. Each number is correctly rounded. Throws
/// InvalidInput for any other text, for NaN and for infinity.
std::vector<double> parse_numbers(std::string_view text);

/// A pose from 3 numbers (x y z), 7 numbers (x y z qw qx qy qz, with a quaternion of any non-zero length) or 16 numbers
/// (a 4x4 matrix, row by row). Throws InvalidInput for any other count, a zero quaternion, and a matrix that is not a
/// rigid displacement.
Pose parse_pose(std::string_view text);

/// A pose from the same numbers.
Pose pose_from_numbers(std::span<const double> numbers);

/// A point or vector from exactly 3 numbers. Throws InvalidInput for any other count.
Eigen::Vector3d parse_point(std::string_view text);

} // namespace chasles::io
