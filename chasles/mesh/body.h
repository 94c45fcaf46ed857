// An immutable body as the library works on it: vertices, polygon faces, unique edges, feature ownership and the
// bounding volume hierarchy (BVH) over its faces. Polyhedron is the public handle of one.
#pragma once

#include "chasles/base/flat_lists.h"
#include "chasles/hierarchy/bvh.h"
#include "chasles/mesh/edge.h"
#include "chasles/mesh/polyhedron.h"

#include <mutex>

namespace chasles {

/// Everything that makes up a body. Each vertex and each edge is owned by exactly one of its faces, so a traversal over
/// pairs of faces tests it once.
struct BodyParts {
    std::vector<Eigen::Vector3d> vertices;
    FlatLists<std::uint32_t> outlines;
    std::vector<std::uint32_t> source; ///< input ids of the faces; empty where every face keeps its input id
    FlatLists<std::uint32_t> triangles;
    FlatLists<std::uint32_t> owned_vertices;
    FlatLists<Edge> owned_edges;
    Bvh bvh;
    MeshReport report;
};

class Body {
public:
    explicit Body(BodyParts parts) : parts_(std::move(parts)) {}

    [[nodiscard]] std::size_t face_count() const { return parts_.outlines.size(); }

    /// The vertices, n points in the body's frame.
    [[nodiscard]] std::span<const Eigen::Vector3d> vertices() const { return parts_.vertices; }

    /// The outline of a face: its vertex ids in order, at least three.
    [[nodiscard]] std::span<const std::uint32_t> face(std::size_t face) const { return parts_.outlines[face]; }

    /// The id that a face had in the input. It differs from `face` only where collapsed faces were dropped or
    /// polygons were cut.
    [[nodiscard]] std::uint32_t source_face(std::size_t face) const {
        return parts_.source.empty() ? static_cast<std::uint32_t>(face) : parts_.source[face];
    }

    /// Triangles that cover a face, as corner positions within the outline, three by three. Empty for a convex face,
    /// which covers itself. The inner diagonals are not edges of the body.
    [[nodiscard]] std::span<const std::uint32_t> face_triangles(std::size_t face) const {
        return parts_.triangles[face];
    }

    /// Vertices and edges owned by a face. Each vertex of the surface and each edge occurs for exactly one face.
    [[nodiscard]] std::span<const std::uint32_t> owned_vertices(std::size_t face) const {
        return parts_.owned_vertices[face];
    }
    [[nodiscard]] std::span<const Edge> owned_edges(std::size_t face) const { return parts_.owned_edges[face]; }

    /// The faces that have a vertex as a corner, in ascending order. The first call computes the lists of all vertices.
    [[nodiscard]] std::span<const std::uint32_t> faces_around(std::size_t vertex) const;

    /// Boxes over the faces, in the body's frame.
    [[nodiscard]] const Bvh& bvh() const { return parts_.bvh; }

    [[nodiscard]] const MeshReport& report() const { return parts_.report; }

    /// Bytes held, without the vertices.
    [[nodiscard]] std::size_t memory() const;

private:
    BodyParts parts_;
    mutable std::once_flag faces_around_once_;
    mutable FlatLists<std::uint32_t> faces_around_;
};

} // namespace chasles
