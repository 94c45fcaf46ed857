// How deep two bodies are in each other, and how often a point crosses a surface. Judges
// answers; shares no code with them.
#pragma once

#include "chasles/mesh/polyhedron.h"
#include "chasles/motion/pose.h"

#include <array>
#include <vector>

namespace chasles::bench {

/// The triangles of a body at the origin.
class Surface {
public:
    explicit Surface(const Polyhedron& body);

    /// How far a point inside is from the surface; 0 for a point outside. Inside is where a ray along z crosses the
    /// surface an odd number of times. The body has to be closed.
    [[nodiscard]] double depth(const Eigen::Vector3d& point) const;
    /// How many triangles a segment crosses.
    [[nodiscard]] std::size_t crossings(const Eigen::Vector3d& from, const Eigen::Vector3d& to) const;
    [[nodiscard]] bool is_closed() const { return is_closed_; }

private:
    using Corners = std::array<Eigen::Vector3d, 3>;
    [[nodiscard]] bool is_inside(const Eigen::Vector3d& point) const;
    [[nodiscard]] std::size_t column(double x, double y) const;

    bool is_closed_;
    Eigen::Vector3d lower_, upper_;
    std::size_t cells_; ///< of the grid over x and y, in each direction
    std::vector<Corners> triangles_;
    std::vector<std::vector<std::uint32_t>> columns_; ///< the triangles over each cell
};

/// The greatest depth of vertices of both bodies inside of the other one; of the first vertices found
/// inside, at most as many as half a million pairs of a vertex and a triangle allow.
double penetration(const Polyhedron& moving, const Surface& moving_surface, const Polyhedron& fixed,
                   const Surface& fixed_surface, const Pose& pose);

} // namespace chasles::bench
