// The distance of two segments, and of a point and a triangle: by clamping, in plain doubles, for checks of contacts.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>

namespace chasles::test {

using Segment3 = std::array<Eigen::Vector3d, 2>;

inline double distance_to_segment(const Eigen::Vector3d& p, const Segment3& s) {
    const Eigen::Vector3d u = s[1] - s[0];
    const double along = std::clamp(u.dot(p - s[0]) / u.squaredNorm(), 0.0, 1.0);
    return (p - s[0] - along * u).norm();
}

/// The minimum over the ends and, if both feet lie inside, the common normal.
inline double distance_of_segments(const Segment3& a, const Segment3& b) {
    double least = std::min({distance_to_segment(a[0], b), distance_to_segment(a[1], b), distance_to_segment(b[0], a),
                             distance_to_segment(b[1], a)});
    const Eigen::Vector3d u = a[1] - a[0];
    const Eigen::Vector3d v = b[1] - b[0];
    const Eigen::Vector3d n = u.cross(v);
    if (n.squaredNorm() < 1e-24 * u.squaredNorm() * v.squaredNorm())
        return least;
    const double on_a = (b[0] - a[0]).cross(v).dot(n) / n.squaredNorm();
    const double on_b = (b[0] - a[0]).cross(u).dot(n) / n.squaredNorm();
    if (on_a >= 0 && on_a <= 1 && on_b >= 0 && on_b <= 1)
        least = std::min(least, std::abs(n.normalized().dot(b[0] - a[0])));
    return least;
}

inline double distance_to_triangle(const Eigen::Vector3d& p, const std::array<Eigen::Vector3d, 3>& t) {
    const Eigen::Vector3d n = (t[1] - t[0]).cross(t[2] - t[0]);
    double least = std::min({distance_to_segment(p, {t[0], t[1]}), distance_to_segment(p, {t[1], t[2]}),
                             distance_to_segment(p, {t[2], t[0]})});
    const auto inside = [&](int i) { return n.dot((t[(i + 1) % 3] - t[i]).cross(p - t[i])) >= 0; };
    if (inside(0) && inside(1) && inside(2))
        least = std::min(least, std::abs(n.normalized().dot(p - t[0])));
    return least;
}

} // namespace chasles::test
