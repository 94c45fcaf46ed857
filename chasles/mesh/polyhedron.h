// An immutable rigid body with polygon faces. Queries move two of them against each other.
// All lengths are in the unit of the mesh; no unit is preferred.
#pragma once

#include "chasles/base/export.h"

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace chasles {

/// Whether the volume that a surface encloses belongs to the body (docs/derivations/37-inside.md).
enum class Solid : std::uint8_t {
    automatic, ///< of each connected part that is closed and whose faces are all turned the same way
    yes,       ///< as automatic, and every part has to be such; otherwise the mesh is refused
    no,        ///< the body is its surface
};

/// Options for making a body: the treatment of unusual faces, and the number of threads.
struct PolyhedronOptions {
    /// Cut polygons that are not planar, and outlines that cross themselves or turn back, into triangles. Otherwise
    /// they are refused.
    bool triangulate = false;
    /// Build the hierarchy on at most this many threads (0: all cores). The body is the same bit by bit for any number
    /// of threads. Bodies with fewer than 32,768 faces use only the calling thread.
    unsigned threads = 0;
    Solid solid = Solid::automatic;
    /// The body is its polyhedron and all points within this distance of it, in the length unit. Below 0, the planes of
    /// the faces of a closed body move inwards by at most so much: an overlap that is allowed
    /// (docs/derivations/38-radius.md).
    double radius = 0;
};

/// Counts and dimensions of a mesh; see Polyhedron::report().
struct MeshReport {
    std::size_t vertices = 0;          ///< as given
    std::size_t distinct_vertices = 0; ///< after merging vertices with equal coordinates
    std::size_t faces = 0;             ///< kept
    std::size_t triangles = 0;         ///< triangles if every polygon were cut
    std::size_t polygons = 0;          ///< faces with more than three vertices
    std::size_t edges = 0;             ///< distinct edges
    std::size_t boundary_edges = 0;    ///< edges with one face that is kept
    std::size_t nonmanifold_edges = 0; ///< edges with three faces or more
    std::size_t dropped_faces = 0;     ///< faces without area that edges of other faces cover
    std::size_t segments = 0;          ///< kept faces without area, each a segment between two vertices, or a point
    bool closed = false;               ///< no boundary edge, faces that are dropped counted
    std::size_t unpaired_edges = 0; ///< edges that faces do not run along equally often in both directions: of the rim,
                                    ///< and between faces that are turned differently; faces that are dropped counted
    std::size_t parts = 0;          ///< connected parts of the surface
    std::size_t solid_parts = 0;    ///< closed parts whose volume belongs to the body; see Solid
    std::size_t inward_parts = 0;   ///< closed parts that are turned inwards: rooms and cavities, which are empty
    double volume = 0; ///< of both, cubic mesh unit: what is turned inwards counts less than nothing, what is covered
                       ///< twice counts twice
    Eigen::Vector3d lower = Eigen::Vector3d::Zero(); ///< lower corner of the bounding box: of all used vertices,
                                                     ///< widened by the radius; in the length unit
    Eigen::Vector3d upper = Eigen::Vector3d::Zero(); ///< upper corner
    double radius = 0;         ///< the body is its polyhedron and all points within so much of it, in the length unit
    double moved_inwards = 0;  ///< faces have moved inwards by at most so much: made with a radius below 0
    std::size_t bvh_nodes = 0; ///< nodes of the bounding volume hierarchy (BVH)
    std::size_t bvh_depth = 0; ///< levels of the BVH
    std::size_t bvh_bytes = 0; ///< memory of the BVH in bytes
};

class Body;

/// A polyhedral surface. It never changes after construction. Copies share the same data, and threads may share a copy.
/// The surface need not be closed.
///
/// Vertices with equal coordinates count as one vertex. Its feature id is the index of the first of them.
class CHASLES_EXPORT Polyhedron {
public:
    /// Makes a body from `vertices` (n points, in any length unit) and `faces` (m lists of at least three vertex
    /// indices from 0). Throws InvalidInput with the number of the face or vertex. It refuses a mesh without faces, and
    /// an index out of range. It refuses a coordinate that is NaN, infinite, or beyond 1e30 in magnitude, and a body
    /// smaller than 1e-30. It refuses a mesh in which no face has an area. It refuses an outline that crosses itself or
    /// turns back onto itself, and a polygon that is not planar, unless options.triangulate. The tolerance for planar
    /// polygons is 1e-5 of the greater of the size and the coordinates (docs/decisions/0010-polygon-planarity.md).
    ///
    /// A face without area, because all its vertices lie on one line, is accepted. The parts of its line that no edge
    /// of another face covers are kept as segments with edges and vertices (docs/decisions/0071-faces-without-area.md).
    ///
    /// A radius must be finite and at most 1e30 in magnitude. One above 0 is kept, and a mesh without area is a body
    /// with it: a face a, b, b is a segment, and p, p, p a point. One below 0 moves vertices once, here: the vertices
    /// of the body are the moved ones, and its own radius is 0. It needs a closed surface whose faces are all turned
    /// the same way, and refuses to turn a face over.
    static Polyhedron from_polygons(std::span<const Eigen::Vector3d> vertices,
                                    std::span<const std::vector<std::uint32_t>> faces,
                                    const PolyhedronOptions& options = {});

    /// Like `from_polygons`, for faces stored anywhere in memory, for example one after another in one array.
    static Polyhedron from_outlines(std::span<const Eigen::Vector3d> vertices,
                                    std::span<const std::span<const std::uint32_t>> outlines,
                                    const PolyhedronOptions& options = {});

    /// Reads a file (docs/files.md) as one body; `load_parts` keeps its parts apart. Throws InvalidInput with the file
    /// name, the line number if the format has lines, and the reason. Defined in chasles/io/mesh_files.cpp.
    static Polyhedron load(const std::filesystem::path& file, const PolyhedronOptions& options = {});

    /// The same polyhedron with another radius, which counts as PolyhedronOptions::radius. It is solid if this one is.
    /// Throws InvalidInput as from_polygons.
    [[nodiscard]] Polyhedron with_radius(double radius) const;

    [[nodiscard]] std::size_t vertex_count() const;
    [[nodiscard]] std::size_t face_count() const;

    /// The vertices: n points in the body's frame, in the length unit.
    [[nodiscard]] std::span<const Eigen::Vector3d> vertices() const;

    /// The outline of a face: at least three vertex ids in order. `face` is below face_count(). A segment is the
    /// outline a, b, b of its two vertices; a single point is p, p, p.
    [[nodiscard]] std::span<const std::uint32_t> face(std::size_t face) const;

    /// Outlines from which `from_outlines` makes this body again: its faces, then dropped faces without area that close
    /// gaps of the surface, where a vertex lies on an edge of another face. Without these the body may not be solid.
    [[nodiscard]] std::vector<std::span<const std::uint32_t>> outlines() const;

    /// The id of a face in the input. `face` is below outlines().size(). It differs from `face` only if there are faces
    /// without area or cut polygons.
    [[nodiscard]] std::uint32_t source_face(std::size_t face) const;

    /// For a body that was made again from `outlines`: the same body with the input ids of the first one, one for each
    /// outline, and with its report().moved_inwards, which may change answers. Throws InvalidInput for another number
    /// of ids.
    [[nodiscard]] Polyhedron with_sources(std::span<const std::uint32_t> source_faces, double moved_inwards) const;

    /// Triangles that cover a face that is not convex: positions of corners in the outline, three for each triangle.
    /// Empty for a convex face. The inner diagonals are not edges of the body.
    [[nodiscard]] std::span<const std::uint32_t> face_triangles(std::size_t face) const;

    /// Triangles that cover any face: vertex ids. A convex face is a fan at its first corner.
    [[nodiscard]] std::vector<std::array<std::uint32_t, 3>> triangles(std::size_t face) const;

    /// The body is the polyhedron and all points within this distance of it, in the length unit; at least 0.
    [[nodiscard]] double radius() const;

    /// Counts and dimensions of the mesh.
    [[nodiscard]] MeshReport report() const;

    /// Bytes held, not counting the vertices.
    [[nodiscard]] std::size_t memory() const;

    /// The internal body, for use by the library. Its type is not part of the public interface.
    [[nodiscard]] const Body& body() const { return *body_; }

private:
    explicit Polyhedron(std::shared_ptr<const Body> body);
    std::shared_ptr<const Body> body_;
};

} // namespace chasles
