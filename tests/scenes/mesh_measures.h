// Measures of closed triangle meshes with outward orientation.
#pragma once

#include "chasles/mesh/polyhedron.h"

#include <Eigen/Geometry>
#include <array>
#include <map>
#include <utility>

namespace chasles::scenes {

using Corners = std::array<Eigen::Vector3d, 3>;

inline Corners corners_of(const Polyhedron& body, std::size_t face) {
    const auto outline = body.face(face);
    return {body.vertices()[outline[0]], body.vertices()[outline[1]], body.vertices()[outline[2]]};
}

/// The volume; positive if the faces are counter-clockwise when viewed from outside.
inline double volume(const Polyhedron& body) {
    double six_fold = 0;
    for (std::size_t face = 0; face < body.face_count(); ++face) {
        const auto [a, b, c] = corners_of(body, face);
        six_fold += a.dot(b.cross(c));
    }
    return six_fold / 6;
}

/// The number of directed edges that do not occur exactly once, together with their reverse.
inline int unpaired_edges(const Polyhedron& body) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> count;
    for (std::size_t face = 0; face < body.face_count(); ++face) {
        const auto outline = body.face(face);
        for (std::size_t i = 0; i < outline.size(); ++i)
            ++count[{outline[i], outline[(i + 1) % outline.size()]}];
    }
    int unpaired = 0;
    for (const auto& [edge, times] : count) {
        if (times != 1 || !count.contains({edge.second, edge.first}))
            ++unpaired;
    }
    return unpaired;
}

} // namespace chasles::scenes
