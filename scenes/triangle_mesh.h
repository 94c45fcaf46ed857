// A triangle mesh under construction: parts are added, cut off at planes and joined without a gap.
#pragma once

#include "chasles/mesh/polyhedron.h"

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <filesystem>
#include <vector>

namespace chasles::scenes {

using Index = std::uint32_t;
using Triangle = std::array<Index, 3>; ///< counter-clockwise seen from outside

struct TriangleMesh {
    std::vector<Eigen::Vector3d> vertices;
    std::vector<Triangle> triangles;

    Index add(const Eigen::Vector3d& vertex);

    /// Vertices that no triangle uses are left out. Throws InvalidInput as Polyhedron::from_polygons().
    [[nodiscard]] Polyhedron polyhedron() const;
};

/// The sides of a plane z = height.
enum class Side : std::uint8_t { below, above };

/// The part of a surface on one side of the plane z = height. New vertices lie exactly on the plane, and a vertex
/// nearer to it than `snap` is moved onto it, so that no sliver thinner than that is left.
TriangleMesh cut_off(const TriangleMesh& mesh, Side kept, double height, double snap);

/// The open rim of a surface on the plane z = height, as one loop in the direction of the surface's own edges.
/// Throws InvalidInput if the rim is not exactly one closed loop.
std::vector<Index> rim(const TriangleMesh& mesh, double height);

/// Closes a rim that is star-shaped about the point (0, 0, z) of its plane by a fan from there.
void close_with_fan(TriangleMesh& mesh, const std::vector<Index>& rim);

/// Fills the flat ring between a rim that is star-shaped about the z axis and the regular polygon `outer` about the
/// same axis, which stands clear of it and runs the same way round. Each rim edge is joined to the corner nearest to
/// where it starts.
void close_with_ring(TriangleMesh& mesh, const std::vector<Index>& rim, const std::vector<Index>& outer);

/// Turns the surface inside out.
void flip(TriangleMesh& mesh);

/// Writes a body as Wavefront OBJ, each number so that it reads back to the same double.
/// Throws InvalidInput if the file cannot be written.
void save_obj(const Polyhedron& body, const std::filesystem::path& file);

} // namespace chasles::scenes
