// Exact predicates of points: the orientation of three points, collinearity and coplanarity. Results are exact for the
// given doubles. A rounded value decides if it exceeds its error bound (J. Shewchuk, 1997); otherwise exact arithmetic
// decides.
#pragma once

#include <Eigen/Core>
#include <cmath>
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

namespace detail {
bool are_coplanar_exactly(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c,
                          const Eigen::Vector3d& d);
}

/// Whether a, b, c, d lie in one plane. Inlined: most points of a mesh are told apart by the filter.
[[nodiscard]] inline bool are_coplanar(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c,
                                       const Eigen::Vector3d& d) {
    // Shewchuk's filter for orient3d: its permanent is at most six times the product of the greatest coordinates, and
    // its factor is below 8 units. Coordinates are at most 1e30, so 1e-250 is far above any underflow.
    constexpr double error = 48 * 0x1p-53;
    constexpr double underflow = 1e-250;
    const Eigen::Vector3d ad = a - d;
    const Eigen::Vector3d bd = b - d;
    const Eigen::Vector3d cd = c - d;
    const double size = ad.cwiseAbs().maxCoeff() * bd.cwiseAbs().maxCoeff() * cd.cwiseAbs().maxCoeff();
    const double volume = ad.x() * (bd.y() * cd.z() - bd.z() * cd.y()) + ad.y() * (bd.z() * cd.x() - bd.x() * cd.z()) +
                          ad.z() * (bd.x() * cd.y() - bd.y() * cd.x());
    return !(std::abs(volume) > error * size + underflow) && detail::are_coplanar_exactly(a, b, c, d);
}

/// Whether b lies outside the closed segment from a to c. The three points must lie on one line.
[[nodiscard]] bool lies_beyond(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c);

} // namespace chasles
