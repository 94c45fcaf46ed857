#include "chasles/robot/overlap_surface.h"

#include "chasles/contact/relative_configuration.h"
#include "chasles/culling/winding.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace chasles::robot {

namespace {

using Eigen::Vector3d;

/// Surfaces with more faces have enough points without some of their edges.
constexpr std::size_t many_faces = 200;
/// The inner points are among the middles of the cells of a grid, so many along each side of the box.
constexpr int inner_cells = 6;
/// Of all lengths that enter.
constexpr double rounding_share = 1e-12;

} // namespace

Vector3d nearest_on(const Triangle& triangle, const Vector3d& point) {
    const auto& [a, b, c] = triangle;
    const Vector3d normal = (b - a).cross(c - a);
    const double square = normal.squaredNorm();
    if (square > 0 && normal.cross(b - a).dot(point - a) >= 0 && normal.cross(c - b).dot(point - b) >= 0 &&
        normal.cross(a - c).dot(point - c) >= 0)
        return point - normal * (normal.dot(point - a) / square);
    Vector3d nearest = a;
    double least = std::numeric_limits<double>::infinity();
    for (const auto& [from, to] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)}) {
        const Vector3d foot = from == to ? from : contact::foot_on_segment(from, to, point);
        if (const double distance = (point - foot).squaredNorm(); distance < least) {
            nearest = foot;
            least = distance;
        }
    }
    return nearest;
}

OverlapSurface::OverlapSurface(const Polyhedron& shape) : body_(&shape.body()) {
    for (std::size_t face = 0; face < shape.face_count(); ++face)
        add_face(shape, face);
    first_triangle_.push_back(triangles_.size());
    for (const Vector3d& vertex : shape.vertices()) {
        points_.push_back(vertex);
        box_.extend(vertex);
    }
    size_ = box_.min().lpNorm<1>() + box_.max().lpNorm<1>() + body_->radius();
    if (is_solid())
        add_inner_points();
}

/// Its triangles, and some points of it. The warp is the extent of its corners across it.
void OverlapSurface::add_face(const Polyhedron& shape, std::size_t face) {
    first_triangle_.push_back(triangles_.size());
    const auto vertices = shape.vertices();
    const auto outline = shape.face(face);
    Vector3d normal = Vector3d::Zero();
    for (const auto& [a, b, c] : shape.triangles(face)) {
        triangles_.push_back({vertices[a], vertices[b], vertices[c]});
        points_.emplace_back((vertices[a] + vertices[b] + vertices[c]) / 3);
        normal += (vertices[b] - vertices[a]).cross(vertices[c] - vertices[a]);
    }
    if (outline.size() > 3 && normal.squaredNorm() > 0) {
        const Vector3d unit = normal.normalized();
        double least = std::numeric_limits<double>::infinity(), greatest = -least;
        for (const std::uint32_t vertex : outline) {
            least = std::min(least, unit.dot(vertices[vertex]));
            greatest = std::max(greatest, unit.dot(vertices[vertex]));
        }
        warp_ = std::max(warp_, greatest - least);
    }
    for (std::size_t i = 0; i < outline.size() && shape.face_count() <= many_faces; ++i) {
        const Vector3d &from = vertices[outline[i]], &to = vertices[outline[(i + 1) % outline.size()]];
        for (const double share : {0.25, 0.5, 0.75})
            points_.emplace_back(from + share * (to - from));
    }
}

void OverlapSurface::add_inner_points() {
    const double rounding = rounding_share * size_ + warp_;
    const auto place_of = [](int i) { return (i + 0.5) / inner_cells; };
    for (int i = 0; i < inner_cells * inner_cells * inner_cells; ++i) {
        const Vector3d share(place_of(i % inner_cells), place_of(i / inner_cells % inner_cells),
                             place_of(i / (inner_cells * inner_cells)));
        const Vector3d point = box_.min() + share.cwiseProduct(box_.sizes());
        if (contains(point, rounding))
            inner_points_.push_back({point, distance(point) - rounding});
    }
    std::ranges::stable_sort(inner_points_, std::ranges::greater(), &InnerPoint::depth);
}

/// A bound from below of the distance of the surface, by bisection.
double OverlapSurface::distance(const Vector3d& point) const {
    double low = 0, high = box_.sizes().norm();
    for (int i = 0; i < 12; ++i) {
        const double middle = 0.5 * (low + high);
        const auto is_within = [&](const Triangle& t) { return (nearest_on(t, point) - point).norm() <= middle; };
        (has_triangle(point, middle, is_within) ? high : low) = middle;
    }
    return low;
}

bool OverlapSurface::contains(const Vector3d& point, double rounding) const {
    const culling::WeightedPoint<double> place{{point.x(), point.y(), point.z()}, 1, rounding};
    return culling::is_inside(*body_, place, point, rounding).value_or(false);
}

} // namespace chasles::robot
