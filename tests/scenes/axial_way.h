// Placed bodies, their close pairs of faces, and the axial distance by projection, without any collision code.
#pragma once

#include "chasles/motion/pose.h"
#include "tests/scenes/mesh_measures.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <vector>

namespace chasles::scenes {

inline std::vector<Corners> placed(const Polyhedron& body, const Pose& pose) {
    const Eigen::Isometry3d motion = pose.isometry();
    std::vector<Corners> faces;
    for (std::size_t face = 0; face < body.face_count(); ++face) {
        const auto [a, b, c] = corners_of(body, face);
        faces.push_back({motion * a, motion * b, motion * c});
    }
    return faces;
}

struct Extent {
    Eigen::Vector3d lower;
    Eigen::Vector3d upper;
};

inline Extent extent(const Corners& corner) {
    return {corner[0].cwiseMin(corner[1]).cwiseMin(corner[2]), corner[0].cwiseMax(corner[1]).cwiseMax(corner[2])};
}

/// Calls visit(moving, fixed) for the pairs whose boxes overlap, with the boxes of `fixed` widened along the axis by
/// `reach`.
template <class Visit>
void for_near_pairs(const std::vector<Corners>& moving, const std::vector<Corners>& fixed, double reach,
                    Visit&& visit) {
    std::vector<Extent> boxes;
    for (const Corners& corner : fixed)
        boxes.push_back(extent(corner));
    for (const Corners& corner : moving) {
        const Extent box = extent(corner);
        for (std::size_t i = 0; i < fixed.size(); ++i) {
            if ((boxes[i].lower.array() <= box.upper.array() + Eigen::Array3d(0, 0, reach)).all() &&
                (boxes[i].upper.array() >= box.lower.array()).all()) {
                visit(corner, fixed[i]);
            }
        }
    }
}

/// The part of a planar polygon to the left of the line from `a` to `b`, projected along z.
inline std::vector<Eigen::Vector3d> left_part(const std::vector<Eigen::Vector3d>& outline, const Eigen::Vector3d& a,
                                              const Eigen::Vector3d& b) {
    const auto left = [&](const Eigen::Vector3d& p) {
        return (b.x() - a.x()) * (p.y() - a.y()) - (b.y() - a.y()) * (p.x() - a.x());
    };
    std::vector<Eigen::Vector3d> part;
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const Eigen::Vector3d& here = outline[i];
        const Eigen::Vector3d& next = outline[(i + 1) % outline.size()];
        if (left(here) >= 0)
            part.push_back(here);
        if (left(here) * left(next) < 0)
            part.push_back(here + left(here) / (left(here) - left(next)) * (next - here));
    }
    return part;
}

inline Eigen::Vector3d normal_of(const Corners& corner) {
    return (corner[1] - corner[0]).cross(corner[2] - corner[0]);
}

/// The distance that `lower` (facing up) can rise until it touches `upper` (facing down). Empty if they pass each
/// other.
inline std::optional<double> rise(const Corners& lower, const Corners& upper) {
    const Eigen::Vector3d normal = normal_of(upper);
    std::vector<Eigen::Vector3d> common(lower.begin(), lower.end());
    for (int i = 0; i < 3; ++i)
        common = left_part(common, upper[(i + 1) % 3], upper[i]);
    std::optional<double> least;
    for (const Eigen::Vector3d& point : common) {
        const double way = normal.dot(upper[0] - point) / normal.z();
        if (!least || way < *least)
            least = way;
    }
    return least && *least > -1e-9 ? least : std::nullopt;
}

/// The distance of a pull along +z until the first contact. Each facet is a linear function of (x, y), so the gap
/// between two facets is linear over their common projection.
inline double way_to_contact(const std::vector<Corners>& moving, const std::vector<Corners>& fixed) {
    double least = std::numeric_limits<double>::infinity();
    for_near_pairs(moving, fixed, 1, [&](const Corners& lower, const Corners& upper) {
        if (normal_of(lower).z() <= 1e-9 || normal_of(upper).z() >= -1e-9)
            return;
        least = std::min(least, rise(lower, upper).value_or(least));
    });
    return least;
}

} // namespace chasles::scenes
