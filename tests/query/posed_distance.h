// The distance of two polyhedra at rest, by all pairs of triangles.
#pragma once

#include "chasles/mesh/polyhedron.h"
#include "chasles/motion/pose.h"
#include "tests/support/surface_distance.h"

#include <limits>

namespace chasles::test {

/// The distance of two surfaces, the first at a pose.
inline double distance_at(const Polyhedron& moving, const Polyhedron& fixed, const Pose& pose) {
    const auto triangles = [](const Polyhedron& body, const Eigen::Isometry3d& placement) {
        std::vector<Triangle3<double>> result;
        for (std::size_t f = 0; f < body.face_count(); ++f)
            for (std::size_t i = 2; i < body.face(f).size(); ++i) {
                const auto corner = [&](std::size_t at) -> Point3<double> {
                    return placement * body.vertices()[body.face(f)[at]];
                };
                result.push_back({corner(0), corner(i - 1), corner(i)});
            }
        return result;
    };
    double least = std::numeric_limits<double>::infinity();
    const auto others = triangles(fixed, Eigen::Isometry3d::Identity());
    for (const Triangle3<double>& a : triangles(moving, pose.isometry()))
        for (const Triangle3<double>& b : others)
            least = std::min(least, squared_distance_of_triangles<double>(a, b));
    return std::sqrt(least);
}

} // namespace chasles::test
