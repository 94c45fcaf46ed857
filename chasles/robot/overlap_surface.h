// Points of a surface that are deep inside of another body: however little both move, the bodies touch.
// Source: docs/derivations/29-robots.md, "Pairs that never touch", and 40-ranges.md, "In contact".
#pragma once

#include "chasles/mesh/body.h"

#include <Eigen/Geometry>
#include <array>
#include <vector>

namespace chasles::robot {

/// A body, and points of its surface.
class OverlapSurface {
public:
    /// The body is kept by reference.
    explicit OverlapSurface(const Polyhedron& shape);

    [[nodiscard]] const Body& body() const { return *body_; }
    [[nodiscard]] const std::vector<Eigen::Vector3d>& points() const { return points_; }
    [[nodiscard]] const Eigen::AlignedBox3d& box() const { return box_; }

    /// Whether the body comes within `reach` of any point that is no farther than `slack` from this one, in the frame
    /// of the body. False where that is not proven. Lengths are off by at most `rounding`.
    [[nodiscard]] bool holds(const Eigen::Vector3d& point, double reach, double slack, double rounding) const;

private:
    template <class Test>
    [[nodiscard]] bool has_triangle(const Eigen::Vector3d& point, double within, const Test& test) const;

    const Body* body_;
    std::vector<Eigen::Vector3d> points_;
    std::vector<std::array<Eigen::Vector3d, 3>> triangles_;
    std::vector<std::size_t> first_triangle_; ///< of each face, and at last the number of triangles
    Eigen::AlignedBox3d box_;                 ///< of the vertices
};

/// How two surfaces may be displaced, and how near counts as touching.
struct Displacement {
    double way = 0;    ///< no point moves farther, as seen from the other body
    double margin = 0; ///< of the question
    double size = 0;   ///< of the lengths that enter the relative pose
};

/// Whether bodies are proven to touch, or to be within the margin, wherever no point is farther from its place than the
/// displacement. `relative` places the moving body in the frame of the fixed one.
bool overlap_within(const OverlapSurface& moving, const OverlapSurface& fixed, const Eigen::Isometry3d& relative,
                    const Displacement& displacement);

} // namespace chasles::robot
