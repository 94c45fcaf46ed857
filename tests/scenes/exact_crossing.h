// Whether two surfaces cross, by exact signs and without the library: an oracle that can refute "clear".
#pragma once

#include "tests/scenes/mesh_measures.h"

#include <cmath>
#include <gmpxx.h>

namespace chasles::scenes {

/// The sign of the volume of the tetrahedron a b c d: +1, 0 or -1, exactly.
inline int orientation(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c,
                       const Eigen::Vector3d& d) {
    const Eigen::Matrix3d rows = (Eigen::Matrix3d() << a - d, b - d, c - d).finished();
    const double size = rows.cwiseAbs().maxCoeff();
    const double rounded = rows.determinant();
    if (std::abs(rounded) > 1e-13 * size * size * size)
        return rounded > 0 ? 1 : -1;
    mpq_class m[3][3];
    const Eigen::Vector3d* points[] = {&a, &b, &c};
    for (int i = 0; i < 3; ++i) {
        for (int k = 0; k < 3; ++k)
            m[i][k] = mpq_class((*points[i])[k]) - mpq_class(d[k]);
    }
    return sgn(mpq_class(m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
                         m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
                         m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0])));
}

/// Whether the segment p q intersects the triangle. A segment in the triangle's plane counts as no: other pairs then
/// detect its ends or the edges of the other triangle.
inline bool crosses(const Eigen::Vector3d& p, const Eigen::Vector3d& q, const Corners& corner) {
    const int side_of_p = orientation(corner[0], corner[1], corner[2], p);
    const int side_of_q = orientation(corner[0], corner[1], corner[2], q);
    if (side_of_p * side_of_q > 0 || (side_of_p == 0 && side_of_q == 0))
        return false;
    bool has_left = false;
    bool has_right = false;
    for (int i = 0; i < 3; ++i) {
        const int side = orientation(p, q, corner[i], corner[(i + 1) % 3]);
        has_left |= side > 0;
        has_right |= side < 0;
    }
    return !(has_left && has_right);
}

inline bool cross(const Corners& one, const Corners& other) {
    for (int i = 0; i < 3; ++i) {
        if (crosses(one[i], one[(i + 1) % 3], other) || crosses(other[i], other[(i + 1) % 3], one))
            return true;
    }
    return false;
}

} // namespace chasles::scenes
