// An immutable rigid body with polygon faces: what a query moves.
#pragma once

#include "chasles/base/export.h"

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace chasles {

/// What to do with faces that are not as they should be, and how a body is made.
struct PolyhedronOptions {
    /// Cut polygons that are not planar into triangles instead of refusing them.
    bool triangulate = false;
    /// Drop faces without area whose edges belong to other faces too instead of refusing them.
    bool drop_degenerate = false;
    /// Build the hierarchy on at most so many threads (0: all cores). The body is the same to the last bit. Others than
    /// the calling thread are asked only for 32,768 faces or more.
    unsigned threads = 0;
};

/// How a mesh hangs together; see Polyhedron::report().
struct MeshReport {
    std::size_t vertices = 0;          ///< as given
    std::size_t distinct_vertices = 0; ///< after merging vertices with the very same coordinates
    std::size_t faces = 0;             ///< kept
    std::size_t triangles = 0;         ///< after cutting every polygon into triangles
    std::size_t polygons = 0;          ///< faces of more than three vertices
    std::size_t edges = 0;             ///< distinct, each shared by any number of faces
    std::size_t boundary_edges = 0;    ///< with one face
    std::size_t nonmanifold_edges = 0; ///< with three faces or more
    std::size_t dropped_faces = 0;     ///< collapsed faces left out because they add nothing to the surface
    bool closed = false;               ///< no boundary edge
    Eigen::Vector3d lower = Eigen::Vector3d::Zero(); ///< corners of the axis-aligned bounding box, mesh unit
    Eigen::Vector3d upper = Eigen::Vector3d::Zero();
    std::size_t bvh_nodes = 0; ///< nodes, depth and bytes of the bounding volume hierarchy
    std::size_t bvh_depth = 0;
    std::size_t bvh_bytes = 0;
};

class Body;

/// A polyhedral surface that never changes once made; copies share it. It need not be closed.
///
/// Vertices with the very same coordinates are one vertex: feature ids name the first of them.
class CHASLES_EXPORT Polyhedron {
public:
    /// From `vertices` (n points, the mesh's unit) and `faces` (m lists of at least three vertex indices from 0).
    /// Throws InvalidInput, naming the face or the vertex, for: no face, an index out of range, a coordinate that is
    /// NaN or infinite, a face with fewer than 3 distinct vertices, without area, or whose outline crosses itself,
    /// and a polygon that is not planar (unless options.triangulate).
    static Polyhedron from_polygons(std::span<const Eigen::Vector3d> vertices,
                                    std::span<const std::vector<std::uint32_t>> faces,
                                    const PolyhedronOptions& options = {});

    /// `from_polygons` for faces that lie anywhere, say behind one another in one array.
    static Polyhedron from_outlines(std::span<const Eigen::Vector3d> vertices,
                                    std::span<const std::span<const std::uint32_t>> outlines,
                                    const PolyhedronOptions& options = {});

    /// From a file: OBJ, OFF, PLY, STL and what Assimp reads. Defined in chasles/io/mesh_files.cpp.
    /// Throws InvalidInput that names the file, the line where there is one, and the reason.
    static Polyhedron load(const std::filesystem::path& file, const PolyhedronOptions& options = {});

    [[nodiscard]] std::size_t vertex_count() const;
    [[nodiscard]] std::size_t face_count() const;

    /// The vertices, n points in the body's frame.
    [[nodiscard]] std::span<const Eigen::Vector3d> vertices() const;

    /// The outline of a face: its vertex ids in order, at least three.
    [[nodiscard]] std::span<const std::uint32_t> face(std::size_t face) const;

    /// The id that a face had in the input. It differs from `face` only where collapsed faces were dropped or
    /// polygons were cut.
    [[nodiscard]] std::uint32_t source_face(std::size_t face) const;

    /// Triangles (as corner positions within the outline, three by three) that cover a face; empty for a convex face,
    /// which is covered as it stands. The inner diagonals are not edges of the body.
    [[nodiscard]] std::span<const std::uint32_t> face_triangles(std::size_t face) const;

    [[nodiscard]] MeshReport report() const;

    /// Bytes held beyond the vertices.
    [[nodiscard]] std::size_t memory() const;

    /// The body itself, for the library's own use: its type is no part of the public interface.
    [[nodiscard]] const Body& body() const { return *body_; }

private:
    explicit Polyhedron(std::shared_ptr<const Body> body);
    std::shared_ptr<const Body> body_;
};

} // namespace chasles
