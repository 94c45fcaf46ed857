// The winding number of a surface around a point by solid angles (Van Oosterom and Strackee 1983): no ray, no sign
// test.
#pragma once

#include "chasles/mesh/polyhedron.h"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

namespace chasles::test {

/// Near a whole number, unless the point is on the surface or the surface is open.
inline double winding_by_solid_angles(const Polyhedron& body, const Eigen::Vector3d& point) {
    double sum = 0;
    for (std::size_t face = 0; face < body.face_count(); ++face)
        for (const auto& triangle : body.triangles(face)) {
            const Eigen::Vector3d a = body.vertices()[triangle[0]] - point, b = body.vertices()[triangle[1]] - point,
                                  c = body.vertices()[triangle[2]] - point;
            const double x = a.norm(), y = b.norm(), z = c.norm();
            sum += std::atan2(a.dot(b.cross(c)), x * y * z + a.dot(b) * z + b.dot(c) * x + c.dot(a) * y);
        }
    return sum / (2 * std::numbers::pi);
}

} // namespace chasles::test
