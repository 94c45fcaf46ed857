// The internal representation of a body: vertices, polygon faces, unique edges, feature ownership and the bounding
// volume hierarchy (BVH). A body never changes. `Polyhedron` is the public handle of a body.
#pragma once

#include "chasles/base/flat_lists.h"
#include "chasles/hierarchy/bvh.h"
#include "chasles/mesh/edge.h"
#include "chasles/mesh/face_outlines.h"
#include "chasles/mesh/normal_cones.h"
#include "chasles/mesh/polyhedron.h"
#include "chasles/mesh/vertex_blocks.h"
#include "chasles/mesh/volume.h"

#include <mutex>

namespace chasles {

/// The data of a body. Exactly one face owns each vertex and each edge that is not flat; no face owns a flat one.
/// Therefore a traversal of face pairs tests each pair of features once.
struct BodyParts {
    std::vector<Eigen::Vector3d> vertices;
    FlatLists<std::uint32_t> outlines;
    std::vector<std::uint32_t> source; ///< input ids of the faces; empty if every face keeps its input id
    FaceOutlines closing;              ///< dropped faces without area that close gaps of the surface
    FlatLists<std::uint32_t> triangles;
    FlatLists<std::uint32_t> owned_vertices;
    FlatLists<Edge> owned_edges;
    Bvh bvh;
    Volume volume;
    MeshReport report;
};

/// An immutable body. Threads may share it.
class Body {
public:
    explicit Body(BodyParts parts);

    [[nodiscard]] std::size_t face_count() const { return parts_.outlines.size(); }

    /// The vertices: n points in the body's frame and length unit.
    [[nodiscard]] std::span<const Eigen::Vector3d> vertices() const { return parts_.vertices; }

    /// The outline of a face: at least three vertex ids in order; a, b, b for a segment.
    [[nodiscard]] std::span<const std::uint32_t> face(std::size_t face) const { return parts_.outlines[face]; }

    /// Whether a face has no area: a segment with the outline a, b, b, or a point. It has edges and vertices, and no
    /// plane.
    [[nodiscard]] bool is_segment(std::size_t face) const {
        const auto outline = parts_.outlines[face];
        return outline[1] == outline[2];
    }

    /// The id of a face in the input. It differs from `face` only if there are faces without area or cut polygons.
    [[nodiscard]] std::uint32_t source_face(std::size_t face) const {
        return parts_.source.empty() ? static_cast<std::uint32_t>(face) : parts_.source[face];
    }

    /// The dropped faces that close gaps of the surface, where a vertex lies on an edge of another face.
    [[nodiscard]] const FaceOutlines& closing() const { return parts_.closing; }

    /// Triangles that cover a face that is not convex: positions of corners in the outline, three for each triangle.
    /// Empty for a convex face. The inner diagonals are not edges of the body.
    [[nodiscard]] std::span<const std::uint32_t> face_triangles(std::size_t face) const {
        return parts_.triangles[face];
    }

    /// The vertices and edges that a face owns. Exactly one face owns each vertex and each edge that is not flat.
    [[nodiscard]] std::span<const std::uint32_t> owned_vertices(std::size_t face) const {
        return parts_.owned_vertices[face];
    }
    [[nodiscard]] std::span<const Edge> owned_edges(std::size_t face) const { return parts_.owned_edges[face]; }

    /// The faces with a vertex as corner, in ascending order. The first call computes the lists of all vertices.
    [[nodiscard]] std::span<const std::uint32_t> faces_around(std::size_t vertex) const;

    /// The cones around the normals below each node of the hierarchy. The first call computes them.
    [[nodiscard]] std::span<const NormalCone> normal_cones() const;

    /// The vertices in blocks. The first call computes them.
    [[nodiscard]] std::span<const VertexBlock> vertex_blocks() const;

    /// The hierarchy of boxes over the faces, in the body's frame.
    [[nodiscard]] const Bvh& bvh() const { return parts_.bvh; }

    /// The parts of the surface, and which of them enclose a volume that belongs to the body.
    [[nodiscard]] const Volume& volume() const { return parts_.volume; }

    /// The body is its polyhedron and all points within this distance of it, in the length unit.
    [[nodiscard]] double radius() const { return parts_.report.radius; }

    /// A bound of the distance of any point of the body from the centre of the hierarchy, in the length unit: of its
    /// vertices, which is smaller than that of the hierarchy's box, and the radius.
    [[nodiscard]] double ball_radius() const { return ball_radius_; }

    [[nodiscard]] const MeshReport& report() const { return parts_.report; }

    /// All data, for a copy that differs in some of it.
    [[nodiscard]] const BodyParts& parts() const { return parts_; }

    /// Bytes held, not counting the vertices.
    [[nodiscard]] std::size_t memory() const;

private:
    BodyParts parts_;
    double ball_radius_ = 0;
    mutable std::once_flag faces_around_once_;
    mutable FlatLists<std::uint32_t> faces_around_;
    mutable std::once_flag normal_cones_once_;
    mutable std::vector<NormalCone> normal_cones_;
    mutable std::once_flag vertex_blocks_once_;
    mutable std::vector<VertexBlock> vertex_blocks_;
};

/// The distance of the polyhedra of two bodies that are so far from each other: more by both radii, rounded up.
[[nodiscard]] double distance_of_polyhedra(const Body& moving, const Body& fixed, double distance);

} // namespace chasles
