// Exact predicates of points: the orientation of three points, collinearity and coplanarity. Results are exact for the
// given doubles. A rounded value decides if it exceeds its error bound (J. Shewchuk, 1997); otherwise exact arithmetic
// decides.
#pragma once

#include <Eigen/Core>
#include <span>

namespace chasles {

/// The point without one coordinate.
inline Eigen::Vector2d without_axis(int axis, const Eigen::Vector3d& point) {
    return {point[(axis + 1) % 3], point[(axis + 2) % 3]};
}

/// 1 if a, b, c turn to the left, -1 to the right, 0 if they lie on one line.
[[nodiscard]] int orientation(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c);

/// Whether a, b, c lie on one line.
[[nodiscard]] bool are_collinear(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c);

/// Whether a, b, c, d lie in one plane.
[[nodiscard]] bool are_coplanar(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c,
                                const Eigen::Vector3d& d);

/// Whether b lies outside the closed segment from a to c. The three points must lie on one line.
[[nodiscard]] bool lies_beyond(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c);

} // namespace chasles
