#include "bench/discrete_overlap.h"

#include <algorithm>
#include <array>
#include <vector>

namespace chasles::bench {

namespace {

struct PlacedTriangle {
    std::array<Eigen::Vector3d, 3> corners;
    Eigen::AlignedBox3d box;
};

std::vector<PlacedTriangle> placed(const Polyhedron& body, const Eigen::Isometry3d& pose) {
    std::vector<PlacedTriangle> triangles;
    for (std::size_t face = 0; face < body.face_count(); ++face) {
        const auto outline = body.face(face);
        for (std::size_t i = 1; i + 1 < outline.size(); ++i) {
            PlacedTriangle triangle;
            triangle.corners = {pose * body.vertices()[outline[0]], pose * body.vertices()[outline[i]],
                                pose * body.vertices()[outline[i + 1]]};
            for (const Eigen::Vector3d& corner : triangle.corners)
                triangle.box.extend(corner);
            triangles.push_back(triangle);
        }
    }
    return triangles;
}

/// Keeps the triangles that intersect the other body's box, sorted by their lowest x.
void keep_near(std::vector<PlacedTriangle>& triangles, const Eigen::AlignedBox3d& box) {
    std::erase_if(triangles, [&](const PlacedTriangle& triangle) { return !triangle.box.intersects(box); });
    std::sort(triangles.begin(), triangles.end(),
              [](const PlacedTriangle& a, const PlacedTriangle& b) { return a.box.min().x() < b.box.min().x(); });
}

Eigen::AlignedBox3d box_of(const std::vector<PlacedTriangle>& triangles) {
    Eigen::AlignedBox3d box;
    for (const PlacedTriangle& triangle : triangles)
        box.extend(triangle.box);
    return box;
}

double volume(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c, const Eigen::Vector3d& d) {
    return (b - a).cross(c - a).dot(d - a);
}

/// Whether the segment passes strictly through the triangle.
bool pierces(const Eigen::Vector3d& from, const Eigen::Vector3d& to, const std::array<Eigen::Vector3d, 3>& triangle) {
    const auto& [a, b, c] = triangle;
    if (volume(a, b, c, from) * volume(a, b, c, to) >= 0)
        return false;
    const double first = volume(from, to, a, b);
    const double second = volume(from, to, b, c);
    const double third = volume(from, to, c, a);
    return (first > 0 && second > 0 && third > 0) || (first < 0 && second < 0 && third < 0);
}

bool cross_each_other(const PlacedTriangle& a, const PlacedTriangle& b) {
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t next = (i + 1) % 3;
        if (pierces(a.corners[i], a.corners[next], b.corners) || pierces(b.corners[i], b.corners[next], a.corners))
            return true;
    }
    return false;
}

} // namespace

bool is_overlapping(const Polyhedron& moving, const Polyhedron& fixed, const Eigen::Isometry3d& pose) {
    std::vector<PlacedTriangle> a = placed(moving, pose);
    std::vector<PlacedTriangle> b = placed(fixed, Eigen::Isometry3d::Identity());
    const Eigen::AlignedBox3d a_box = box_of(a);
    keep_near(a, box_of(b));
    keep_near(b, a_box);
    std::vector<const PlacedTriangle*> active; // triangles of b that may overlap the x range of the next triangle of a
    std::size_t next = 0;
    for (const PlacedTriangle& triangle : a) {
        while (next < b.size() && b[next].box.min().x() <= triangle.box.max().x())
            active.push_back(&b[next++]);
        for (const PlacedTriangle* other : active)
            if (other->box.intersects(triangle.box) && cross_each_other(triangle, *other))
                return true;
        // Later triangles of `a` do not begin before the lowest x of this triangle.
        std::erase_if(active, [&](const auto* other) { return other->box.max().x() < triangle.box.min().x(); });
    }
    return false;
}

} // namespace chasles::bench
