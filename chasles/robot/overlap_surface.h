// A body with what tests of a pair at one configuration need: triangles, points of the surface, and points inside.
// Source: docs/derivations/40-ranges.md, "Surfaces".
#pragma once

#include "chasles/mesh/body.h"

#include <Eigen/Geometry>
#include <array>
#include <span>
#include <vector>

namespace chasles::robot {

using Triangle = std::array<Eigen::Vector3d, 3>;

class OverlapSurface {
public:
    /// The body is kept by reference.
    explicit OverlapSurface(const Polyhedron& shape);

    [[nodiscard]] const Body& body() const { return *body_; }
    [[nodiscard]] bool is_solid() const { return body_->volume().is_solid(); }
    /// Points of the surface.
    [[nodiscard]] const std::vector<Eigen::Vector3d>& points() const { return points_; }
    /// A point inside of a solid body, and a length by which it is deeper than the surface.
    struct InnerPoint {
        Eigen::Vector3d place;
        double depth;
    };
    /// The deepest one first.
    [[nodiscard]] const std::vector<InnerPoint>& inner_points() const { return inner_points_; }
    [[nodiscard]] const Eigen::AlignedBox3d& box() const { return box_; } ///< of the vertices
    /// The triangles of a face.
    [[nodiscard]] std::span<const Triangle> triangles(std::size_t face) const {
        return std::span(triangles_).subspan(first_triangle_[face], first_triangle_[face + 1] - first_triangle_[face]);
    }
    /// No point of a face is farther from its triangles: polygons need not be planar.
    [[nodiscard]] double warp() const { return warp_; }
    /// The sum of the sizes of all lengths.
    [[nodiscard]] double size() const { return size_; }

    /// Whether a point is in the volume of the body. False where that is not proven.
    [[nodiscard]] bool contains(const Eigen::Vector3d& point, double rounding) const;
    /// Whether the test holds for some triangle among those that may be within a distance of a point.
    template <class Test>
    [[nodiscard]] bool has_triangle(const Eigen::Vector3d& point, double within, const Test& test) const;

private:
    void add_face(const Polyhedron& shape, std::size_t face);
    void add_inner_points();
    [[nodiscard]] double distance(const Eigen::Vector3d& point) const;

    const Body* body_;
    std::vector<Eigen::Vector3d> points_;
    std::vector<InnerPoint> inner_points_;
    std::vector<Triangle> triangles_;
    std::vector<std::size_t> first_triangle_; ///< of each face, and at last the number of triangles
    Eigen::AlignedBox3d box_;
    double warp_ = 0;
    double size_ = 0;
};

/// The point of a triangle that is nearest to a point.
Eigen::Vector3d nearest_on(const Triangle& triangle, const Eigen::Vector3d& point);

template <class Test>
bool OverlapSurface::has_triangle(const Eigen::Vector3d& point, double within, const Test& test) const {
    const Bvh& bvh = body_->bvh();
    const Eigen::Vector3d seen = point - bvh.centre();
    constexpr double rounding = 1e-12;
    const double wide = within * (1 + rounding) + rounding * (bvh.radius() + seen.lpNorm<1>());
    const auto may_be_near = [&](const BvhNode& node) {
        double sum = 0;
        for (std::size_t i = 0; i < 3; ++i) {
            const double x = seen[Eigen::Index(i)];
            const double beside = std::max({double(node.lower[i]) - x, x - double(node.upper[i]), 0.0});
            sum += beside * beside;
        }
        return sum <= wide * wide;
    };
    std::array<std::uint32_t, Bvh::max_depth + 1> waiting; // NOLINT(cppcoreguidelines-pro-type-member-init)
    std::size_t count = 0;
    for (waiting[count++] = 0; count > 0;) {
        const BvhNode& node = bvh.nodes()[waiting[--count]];
        if (!may_be_near(node))
            continue;
        if (!node.is_leaf()) {
            waiting[count++] = node.first;
            waiting[count++] = node.first + 1;
            continue;
        }
        for (const Triangle& triangle : triangles(node.first))
            if (test(triangle))
                return true;
    }
    return false;
}

} // namespace chasles::robot
