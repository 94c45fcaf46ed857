#include "chasles/robot/overlap_proof.h"

#include "chasles/contact/relative_configuration.h"
#include "chasles/culling/winding.h"
#include "chasles/motion/screw_path.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace chasles::robot {

namespace {

using Eigen::Vector3d;

/// So many points of a surface are tried, those nearest to the middle of both boxes.
constexpr std::size_t most_tries = 24;
/// Of all lengths that enter; places are computed in double.
constexpr double rounding_share = 1e-9;

/// The distance of the rim.
double distance_to_rim(const std::array<Vector3d, 3>& triangle, const Vector3d& point) {
    const auto& [a, b, c] = triangle;
    double least = std::numeric_limits<double>::infinity();
    for (const auto& [from, to] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)})
        least = std::min(least, (point - (from == to ? from : contact::foot_on_segment(from, to, point))).norm());
    return least;
}

/// Never more than the distance, but for rounding.
double distance_to(const std::array<Vector3d, 3>& triangle, const Vector3d& point) {
    const auto& [a, b, c] = triangle;
    const Vector3d normal = (b - a).cross(c - a);
    const double rim = distance_to_rim(triangle, point);
    const bool is_beside = normal.squaredNorm() > 0 && normal.cross(b - a).dot(point - a) >= 0 &&
                           normal.cross(c - b).dot(point - b) >= 0 && normal.cross(a - c).dot(point - c) >= 0;
    return is_beside ? std::min(rim, std::abs(normal.dot(point - a)) / normal.norm()) : rim;
}

} // namespace

OverlapProof::OverlapProof(const Model& model, const std::vector<const Element*>& first,
                           const std::vector<const Element*>& second)
    : model_(model), first_(first), second_(second) {
    for (const Element* element : first_)
        of_first_.push_back(surface_of(element->shape));
    for (const Element* element : second_)
        of_second_.push_back(surface_of(element->shape));
}

OverlapProof::Surface OverlapProof::surface_of(const Polyhedron& shape) {
    Surface surface{&shape.body(), {}, {}, {}};
    const auto vertices = shape.vertices();
    const Vector3d radius = Vector3d::Constant(shape.radius());
    for (std::size_t f = 0; f < shape.face_count(); ++f) {
        const auto face = shape.face(f);
        for (const auto& [a, b, c] : shape.triangles(f)) {
            surface.triangles.push_back({vertices[a], vertices[b], vertices[c]});
            surface.points.emplace_back((vertices[a] + vertices[b] + vertices[c]) / 3);
        }
        for (std::size_t i = 0; i < face.size(); ++i) {
            const Vector3d &a = vertices[face[i]], &b = vertices[face[(i + 1) % face.size()]];
            surface.box.extend(Vector3d(a - radius));
            surface.box.extend(Vector3d(a + radius));
            for (const double share : {0.0, 0.25, 0.5, 0.75})
                surface.points.emplace_back(a + share * (b - a));
        }
    }
    return surface;
}

/// Nearer to the polyhedron than both radii, or of the volume and not near its surface, each by more than the margin.
bool OverlapProof::is_inside(const Surface& surface, const Vector3d& point, double radii, double margin,
                             double rounding) {
    if (std::ranges::any_of(surface.triangles,
                            [&](const auto& triangle) { return distance_to_rim(triangle, point) < radii - margin; }))
        return true;
    if (!surface.body->volume().is_solid())
        return false;
    const culling::WeightedPoint<double> place{{point.x(), point.y(), point.z()}, 1, rounding};
    return culling::is_inside(*surface.body, place, point, rounding).value_or(false) &&
           std::ranges::all_of(surface.triangles,
                               [&](const auto& triangle) { return distance_to(triangle, point) > margin; });
}

bool OverlapProof::has_point_inside(const Surface& moving, const Surface& fixed, const Eigen::Isometry3d& relative,
                                    double margin, double rounding) {
    const double radii = moving.body->radius() + fixed.body->radius();
    if (radii == 0 && !fixed.body->volume().is_solid())
        return false;
    std::vector<Vector3d> points;
    Eigen::AlignedBox3d box;
    for (const Vector3d& point : moving.points) {
        points.emplace_back(relative * point);
        box.extend(points.back());
    }
    const Vector3d radius = Vector3d::Constant(moving.body->radius());
    const Eigen::AlignedBox3d wide(fixed.box.min() - radius, fixed.box.max() + radius);
    const Eigen::AlignedBox3d common = box.intersection(wide);
    std::erase_if(points, [&](const Vector3d& point) { return !common.contains(point); });
    const Vector3d middle = common.center();
    const std::size_t tries = std::min(most_tries, points.size());
    std::ranges::partial_sort(points, points.begin() + std::ptrdiff_t(tries), {},
                              [&](const Vector3d& point) { return (point - middle).squaredNorm(); });
    return std::any_of(points.begin(), points.begin() + std::ptrdiff_t(tries),
                       [&](const Vector3d& point) { return is_inside(fixed, point, radii, margin, rounding); });
}

bool OverlapProof::touch_within(double margin, const Configuration& configuration) const {
    const SegmentMotion motion = model_.motion_of({0, 1, configuration.transpose()});
    for (std::size_t i = 0; i < first_.size(); ++i)
        for (std::size_t k = 0; k < second_.size(); ++k) {
            const motion::SharedFrame frame =
                motion::chain_frame(model_.chain_between(motion, *second_[k], *first_[i]));
            const Eigen::Isometry3d relative =
                motion::rounded(frame->refined_at(algebra::DoubleDouble(0.0))).isometry();
            const Surface &a = of_first_[i], &b = of_second_[k];
            const double size = relative.translation().norm() + a.box.min().norm() + a.box.max().norm() +
                                b.box.min().norm() + b.box.max().norm();
            const double rounding = rounding_share * size, wide = margin * (1 + rounding_share) + rounding;
            if (has_point_inside(a, b, relative, wide, rounding) ||
                has_point_inside(b, a, relative.inverse(), wide, rounding))
                return true;
        }
    return false;
}

} // namespace chasles::robot
