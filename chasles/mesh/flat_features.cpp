#include "chasles/mesh/flat_features.h"

#include "chasles/mesh/exact_orientation.h"

#include <algorithm>
#include <array>

namespace chasles {
namespace {

using Eigen::Vector3d;
using Corners = std::span<const std::uint32_t>;

constexpr std::uint32_t no_face = 0xffffffff;

/// The faces at an edge, if there are two.
struct TwoSides {
    std::array<std::uint32_t, 2> faces{no_face, no_face};
    std::uint32_t count = 0;
};

std::vector<TwoSides> faces_at_edges(const FlatLists<std::uint32_t>& outlines, const MeshEdges& edges) {
    std::vector<TwoSides> sides(edges.edges.size());
    for (std::uint32_t face = 0; face < outlines.size(); ++face)
        for (std::uint32_t corner = outlines.offsets[face]; corner < outlines.offsets[face + 1]; ++corner)
            if (const std::uint32_t edge = edges.edge_of_side[corner]; edge != MeshEdges::none) {
                TwoSides& of_edge = sides[edge];
                if (of_edge.count < 2)
                    of_edge.faces[of_edge.count] = face;
                ++of_edge.count;
            }
    return sides;
}

/// An edge between two faces.
class SharedEdge {
public:
    SharedEdge(const Edge& edge, std::span<const Vector3d> vertices) : edge_(edge), vertices_(vertices) {}

    /// Whether the faces lie in one plane, on different sides of the edge.
    [[nodiscard]] bool is_flat(Corners a, Corners b) const {
        const std::uint32_t apex = corner_off_edge(a);
        const auto is_in_plane = [&](std::uint32_t corner) {
            return corner == edge_.from || corner == edge_.to || corner == apex ||
                   are_coplanar(vertices_[edge_.from], vertices_[edge_.to], vertices_[apex], vertices_[corner]);
        };
        if (!std::ranges::all_of(b, is_in_plane) || !std::ranges::all_of(a, is_in_plane))
            return false;
        const std::uint32_t other = corner_off_edge(b);
        for (int axis = 0; axis < 3; ++axis)
            if (const int side = side_of(axis, apex); side != 0)
                return side_of(axis, other) == -side;
        return false;
    }

private:
    /// The corner of a convex face that is not an end of the edge, nor on its line where there are others.
    [[nodiscard]] std::uint32_t corner_off_edge(Corners face) const {
        std::uint32_t found = face[0];
        for (const std::uint32_t corner : face)
            if (corner != edge_.from && corner != edge_.to) {
                found = corner;
                if (face.size() == 3 || !are_collinear(vertices_[edge_.from], vertices_[edge_.to], vertices_[corner]))
                    break;
            }
        return found;
    }
    [[nodiscard]] int side_of(int axis, std::uint32_t corner) const {
        return orientation(without_axis(axis, vertices_[edge_.from]), without_axis(axis, vertices_[edge_.to]),
                           without_axis(axis, vertices_[corner]));
    }

    const Edge& edge_;
    std::span<const Vector3d> vertices_;
};

} // namespace

FlatFeatures find_flat_features(const FlatLists<std::uint32_t>& outlines, const FlatLists<std::uint32_t>& triangles,
                                const MeshEdges& edges, std::span<const Vector3d> vertices) {
    FlatFeatures flat{std::vector<bool>(edges.edges.size()), std::vector<bool>(vertices.size())};
    const std::vector<TwoSides> sides = faces_at_edges(outlines, edges);
    std::vector<bool> has_other(vertices.size());
    for (std::size_t i = 0; i < sides.size(); ++i) {
        const auto& [faces, count] = sides[i];
        const Edge& edge = edges.edges[i];
        const bool is_flat = count == 2 && faces[0] != faces[1] && triangles[faces[0]].empty() &&
                             triangles[faces[1]].empty() &&
                             SharedEdge(edge, vertices).is_flat(outlines[faces[0]], outlines[faces[1]]);
        flat.edges[i] = is_flat;
        for (const std::uint32_t end : {edge.from, edge.to}) {
            flat.vertices[end] = flat.vertices[end] || is_flat;
            has_other[end] = has_other[end] || !is_flat;
        }
    }
    for (std::size_t i = 0; i < vertices.size(); ++i)
        flat.vertices[i] = flat.vertices[i] && !has_other[i];
    return flat;
}

} // namespace chasles
