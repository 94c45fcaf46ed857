// On which side a point lies, and whether points lie on one line: always the answer for the very doubles given.
// A rounded value decides where it is beyond its error bound (J. Shewchuk, 1997), exact arithmetic elsewhere.
#pragma once

#include <Eigen/Core>
#include <span>

namespace chasles {

/// 1 if a, b, c turn to the left, -1 to the right, 0 if they lie on one line.
[[nodiscard]] int orientation(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c);

/// Whether a, b, c lie on one line.
[[nodiscard]] bool are_collinear(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c);

/// Whether the point b of the line through a and c lies outside the closed segment between them. Only for points of
/// one line.
[[nodiscard]] bool lies_beyond(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c);

} // namespace chasles
