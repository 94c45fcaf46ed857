// A triangle mesh under construction. Parts are added, cut off at planes, and joined without gaps.
#pragma once

#include "chasles/mesh/polyhedron.h"

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace chasles::scenes {

using Index = std::uint32_t;
using Triangle = std::array<Index, 3>; ///< counter-clockwise when viewed from outside

struct TriangleMesh {
    std::vector<Eigen::Vector3d> vertices;
    std::vector<Triangle> triangles;

    Index add(const Eigen::Vector3d& vertex);

    /// Omits the vertices that no triangle uses. Throws InvalidInput if Polyhedron::from_polygons() does.
    [[nodiscard]] Polyhedron polyhedron() const;
};

/// The sides of a plane z = height.
enum class Side : std::uint8_t { below, above };

/// The part of a surface on one side of the plane z = height. New vertices lie exactly on the plane. A vertex closer to
/// the plane than `snap` is moved onto the plane, which prevents slivers thinner than `snap`.
TriangleMesh cut_off(const TriangleMesh& mesh, Side kept, double height, double snap);

/// The open rim of a surface on the plane z = height, as one loop in the direction of the edges of its triangles.
/// Throws InvalidInput if the rim is not exactly one closed loop.
std::vector<Index> rim(const TriangleMesh& mesh, double height);

/// Closes a rim by a fan of triangles around the point (0, 0, z) of its plane. The rim must be star-shaped about this
/// point.
void close_with_fan(TriangleMesh& mesh, const std::vector<Index>& rim);

/// Fills the flat ring between a rim and the regular polygon `outer`. Both are star-shaped about the z axis and have
/// the same direction of rotation, and `outer` lies strictly outside the rim. Each rim edge is joined to the corner of
/// `outer` nearest to the start of the edge.
void close_with_ring(TriangleMesh& mesh, const std::vector<Index>& rim, const std::vector<Index>& outer);

/// Turns the surface inside out.
void flip(TriangleMesh& mesh);

/// A body as Wavefront OBJ. Each number reads back to the same double.
std::string obj_text(const Polyhedron& body);

} // namespace chasles::scenes
