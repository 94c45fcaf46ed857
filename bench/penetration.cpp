#include "bench/penetration.h"

#include "bench/bodies.h"
#include "tests/support/segment_distance.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace chasles::bench {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

double cross(const Vector2d& a, const Vector2d& b) {
    return a.x() * b.y() - a.y() * b.x();
}

/// Whether a ray from a point along z crosses a triangle. A ray through an edge counts for one of its two sides.
bool is_above(const std::array<Vector3d, 3>& t, const Vector3d& p) {
    int turns = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        Vector2d a = t[i].head<2>() - p.head<2>(), b = t[(i + 1) % 3].head<2>() - p.head<2>();
        if ((a.y() > 0) == (b.y() > 0))
            continue;
        const double side = cross(a, b);
        if ((side > 0) == (b.y() > a.y()))
            turns += b.y() > a.y() ? 1 : -1;
    }
    if (turns == 0)
        return false;
    const Vector3d normal = (t[1] - t[0]).cross(t[2] - t[0]);
    return normal.dot(t[0] - p) / normal.z() > 0;
}

bool is_between(const std::array<Vector3d, 3>& t, const Vector3d& from, const Vector3d& to) {
    const auto volume = [&](const Vector3d& a, const Vector3d& b, const Vector3d& c) {
        return (b - a).cross(c - a).dot(to - from);
    };
    const Vector3d normal = (t[1] - t[0]).cross(t[2] - t[0]);
    if ((normal.dot(from - t[0]) > 0) == (normal.dot(to - t[0]) > 0))
        return false;
    const bool first = volume(from, t[0], t[1]) > 0;
    return first == (volume(from, t[1], t[2]) > 0) && first == (volume(from, t[2], t[0]) > 0);
}

} // namespace

Surface::Surface(const Polyhedron& body)
    : is_closed_(body.report().closed), lower_(body.report().lower), upper_(body.report().upper),
      cells_(std::size_t(std::sqrt(double(body.face_count()))) + 1), columns_(cells_ * cells_) {
    for (const auto& ids : triangles_of(body)) {
        const Corners t{body.vertices()[ids[0]], body.vertices()[ids[1]], body.vertices()[ids[2]]};
        const Vector3d low = t[0].cwiseMin(t[1]).cwiseMin(t[2]), high = t[0].cwiseMax(t[1]).cwiseMax(t[2]);
        const std::size_t first = column(low.x(), low.y()), last = column(high.x(), high.y());
        for (std::size_t i = first % cells_; i <= last % cells_; ++i)
            for (std::size_t j = first / cells_; j <= last / cells_; ++j)
                columns_[i + j * cells_].push_back(std::uint32_t(triangles_.size()));
        triangles_.push_back(t);
    }
}

std::size_t Surface::column(double x, double y) const {
    const auto cell = [&](double at, double low, double high) {
        return std::size_t(std::clamp((at - low) / (high - low) * double(cells_), 0.0, double(cells_ - 1)));
    };
    return cell(x, lower_.x(), upper_.x()) + cells_ * cell(y, lower_.y(), upper_.y());
}

bool Surface::is_inside(const Vector3d& point) const {
    if ((point.array() < lower_.array()).any() || (point.array() > upper_.array()).any())
        return false;
    std::size_t crossings = 0;
    for (const std::uint32_t i : columns_[column(point.x(), point.y())])
        crossings += is_above(triangles_[i], point) ? 1 : 0;
    return crossings % 2 == 1;
}

double Surface::depth(const Vector3d& point) const {
    if (!is_inside(point))
        return 0;
    double least = 1e300;
    for (const Corners& triangle : triangles_)
        least = std::min(least, test::distance_to_triangle(point, triangle));
    return least;
}

std::size_t Surface::crossings(const Vector3d& from, const Vector3d& to) const {
    const auto is_crossed = [&](const Corners& t) { return is_between(t, from, to); };
    return std::size_t(std::ranges::count_if(triangles_, is_crossed));
}

double penetration(const Polyhedron& moving, const Surface& moving_surface, const Polyhedron& fixed,
                   const Surface& fixed_surface, const Pose& pose) {
    const int most_vertices = std::max(2, int(500'000 / (moving.face_count() + fixed.face_count())));
    const auto deepest = [=](const Polyhedron& body, const Eigen::Isometry3d& to_other, const Surface& other) {
        double depth = 0;
        int found = 0;
        for (const Vector3d& vertex : body.vertices()) {
            const double here = other.depth(to_other * vertex);
            depth = std::max(depth, here);
            found += here > 0 ? 1 : 0;
            if (found == most_vertices)
                break;
        }
        return depth;
    };
    const Eigen::Isometry3d at = pose.isometry();
    return std::max(deepest(moving, at, fixed_surface), deepest(fixed, at.inverse(), moving_surface));
}

} // namespace chasles::bench
