#include "chasles/robot/overlap_proof.h"

#include "chasles/contact/relative_configuration.h"
#include "chasles/motion/screw_path.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace chasles::robot {

namespace {

using Eigen::Vector3d;

/// So many points of a surface are tried, those nearest to the middle of both boxes.
constexpr std::size_t most_tries = 24;
/// Of all lengths that enter; places are computed in double.
constexpr double rounding_share = 1e-9;

/// The connected parts of a surface: vertices that share a face.
class Parts {
public:
    explicit Parts(std::size_t vertices) : above_(vertices) { std::iota(above_.begin(), above_.end(), 0U); }
    std::uint32_t of(std::uint32_t vertex) {
        while (above_[vertex] != vertex)
            vertex = above_[vertex] = above_[above_[vertex]];
        return vertex;
    }
    void join(std::uint32_t a, std::uint32_t b) { above_[of(a)] = of(b); }

private:
    std::vector<std::uint32_t> above_;
};

/// Never more than the distance, but for rounding.
double distance_to(const std::array<Vector3d, 3>& triangle, const Vector3d& point) {
    const auto& [a, b, c] = triangle;
    const Vector3d normal = (b - a).cross(c - a);
    double rim = std::numeric_limits<double>::infinity();
    for (const auto& [from, to] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)})
        rim = std::min(rim, (point - contact::foot_on_segment(from, to, point)).norm());
    const bool is_beside = normal.squaredNorm() > 0 && normal.cross(b - a).dot(point - a) >= 0 &&
                           normal.cross(c - b).dot(point - b) >= 0 && normal.cross(a - c).dot(point - c) >= 0;
    return is_beside ? std::min(rim, std::abs(normal.dot(point - a)) / normal.norm()) : rim;
}

enum class Crossing : std::uint8_t { none, one, doubtful };

/// Of a ray and a triangle; near the rim, and along the plane, it is doubtful.
Crossing crossing_of(const std::array<Vector3d, 3>& triangle, const Vector3d& point, const Vector3d& direction) {
    constexpr double doubt = 1e-9;
    const Vector3d first = triangle[1] - triangle[0], second = triangle[2] - triangle[0];
    const Vector3d across = direction.cross(second);
    const double volume = first.dot(across);
    if (std::abs(volume) <= doubt * first.norm() * second.norm())
        return distance_to(triangle, point) > 0 && first.cross(second).norm() == 0 ? Crossing::none
                                                                                   : Crossing::doubtful;
    const Vector3d from = point - triangle[0];
    const double u = from.dot(across) / volume, v = direction.dot(from.cross(first)) / volume;
    const double least = std::min({u, v, 1 - u - v});
    if (least < -doubt)
        return Crossing::none;
    const double way = second.dot(from.cross(first)) / volume;
    if (way < 0)
        return Crossing::none;
    return least > doubt ? Crossing::one : Crossing::doubtful;
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
    Surface surface;
    const MeshReport report = shape.report();
    surface.is_closed = report.closed && report.nonmanifold_edges == 0 && report.segments == 0;
    const auto vertices = shape.vertices();
    Parts parts(vertices.size());
    for (std::size_t f = 0; f < shape.face_count(); ++f)
        for (const std::uint32_t vertex : shape.face(f))
            parts.join(shape.face(f)[0], vertex);
    for (std::size_t f = 0; f < shape.face_count(); ++f) {
        const auto face = shape.face(f);
        const std::uint32_t part = parts.of(face[0]);
        for (const auto& [a, b, c] : shape.triangles(f)) {
            surface.triangles.push_back({vertices[a], vertices[b], vertices[c]});
            surface.points.push_back({(vertices[a] + vertices[b] + vertices[c]) / 3, part});
        }
        for (std::size_t i = 0; i < face.size(); ++i) {
            const Vector3d &a = vertices[face[i]], &b = vertices[face[(i + 1) % face.size()]];
            surface.box.extend(a);
            for (const double share : {0.0, 0.25, 0.5, 0.75})
                surface.points.push_back({a + share * (b - a), part});
        }
    }
    return surface;
}

/// By the number of times that a ray leaves the surface.
bool OverlapProof::is_inside(const Surface& surface, const Vector3d& point, double margin) {
    for (const auto& triangle : surface.triangles)
        if (!(distance_to(triangle, point) > margin))
            return false;
    for (const Vector3d& direction :
         {Vector3d(0.57, 0.31, 0.76), Vector3d(-0.23, 0.85, 0.47), Vector3d(0.41, -0.62, 0.67)}) {
        bool is_inside = false, is_doubtful = false;
        for (const auto& triangle : surface.triangles) {
            const Crossing crossing = crossing_of(triangle, point, direction);
            is_doubtful = is_doubtful || crossing == Crossing::doubtful;
            is_inside = is_inside != (crossing == Crossing::one);
        }
        if (!is_doubtful)
            return is_inside;
    }
    return false;
}

bool OverlapProof::passes_through(const Surface& moving, const Surface& fixed, const Eigen::Isometry3d& relative,
                                  double margin) {
    if (!fixed.is_closed)
        return false;
    std::vector<SurfacePoint> points;
    Eigen::AlignedBox3d box;
    for (const SurfacePoint& point : moving.points) {
        points.push_back({relative * point.place, point.part});
        box.extend(points.back().place);
    }
    const Eigen::AlignedBox3d common = box.intersection(fixed.box);
    if (common.isEmpty())
        return false;
    // A point beyond the box is outside of it; its part of the surface cannot be inside as a whole.
    std::vector<std::uint32_t> leaving;
    for (const SurfacePoint& point : points)
        if (fixed.box.exteriorDistance(point.place) > margin)
            leaving.push_back(point.part);
    std::ranges::sort(leaving);
    std::erase_if(points, [&](const SurfacePoint& point) {
        return !std::ranges::binary_search(leaving, point.part) || !common.contains(point.place);
    });
    const Vector3d middle = common.center();
    const std::size_t tries = std::min(most_tries, points.size());
    std::ranges::partial_sort(points, points.begin() + std::ptrdiff_t(tries), {},
                              [&](const SurfacePoint& point) { return (point.place - middle).squaredNorm(); });
    return std::any_of(points.begin(), points.begin() + std::ptrdiff_t(tries),
                       [&](const SurfacePoint& point) { return is_inside(fixed, point.place, margin); });
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
            const double wide = margin * (1 + rounding_share) + rounding_share * size;
            if (passes_through(a, b, relative, wide) || passes_through(b, a, relative.inverse(), wide))
                return true;
        }
    return false;
}

} // namespace chasles::robot
