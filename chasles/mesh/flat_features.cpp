#include "chasles/mesh/flat_features.h"

#include "chasles/base/parallel_for.h"
#include "chasles/mesh/exact_orientation.h"

#include <algorithm>

namespace chasles {
namespace {

using Eigen::Vector3d;
using Corners = std::span<const std::uint32_t>;

/// An edge between two faces.
class SharedEdge {
public:
    SharedEdge(const Edge& edge, std::span<const Vector3d> vertices) : edge_(edge), vertices_(vertices) {}

    /// Whether the faces lie in one plane, on different sides of the edge.
    [[nodiscard]] bool is_flat(Corners a, Corners b) const {
        const std::uint32_t apex = corner_off_edge(a);
        const std::uint32_t other = corner_off_edge(b);
        const auto is_in_plane = [&](std::uint32_t corner) {
            return corner == edge_.from || corner == edge_.to || corner == apex ||
                   are_coplanar(vertices_[edge_.from], vertices_[edge_.to], vertices_[apex], vertices_[corner]);
        };
        if (!is_in_plane(other) || !std::ranges::all_of(a, is_in_plane) || !std::ranges::all_of(b, is_in_plane))
            return false;
        for (int axis = 0; axis < 3; ++axis)
            if (const int side = side_of(axis, apex); side != 0)
                return side_of(axis, other) == -side;
        return false;
    }

private:
    /// The corner of a convex face that is not an end of the edge, nor on its line where there are others.
    [[nodiscard]] std::uint32_t corner_off_edge(Corners face) const {
        if (face.size() == 3)
            return face[0] ^ face[1] ^ face[2] ^ edge_.from ^ edge_.to;
        std::uint32_t found = face[0];
        for (const std::uint32_t corner : face)
            if (corner != edge_.from && corner != edge_.to) {
                found = corner;
                if (!are_collinear(vertices_[edge_.from], vertices_[edge_.to], vertices_[corner]))
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
                                const MeshEdges& edges, std::span<const Vector3d> vertices, unsigned threads) {
    constexpr std::size_t many_edges = 1 << 13; // for one thread
    FlatFeatures flat{std::vector<char>(edges.edges.size()), std::vector<char>(vertices.size())};
    parallel_chunks(threads, edges.edges.size(), many_edges, [&](std::size_t, std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const auto& [a, b] = edges.two_faces[i];
            flat.edges[i] = a != MeshEdges::none && triangles[a].empty() && triangles[b].empty() &&
                            SharedEdge(edges.edges[i], vertices).is_flat(outlines[a], outlines[b]);
        }
    });
    flat.has_any = std::ranges::find(flat.edges, char(1)) != flat.edges.end();
    if (!flat.has_any)
        return flat;
    for (std::size_t i = 0; i < edges.edges.size(); ++i)
        if (flat.edges[i] != 0)
            flat.vertices[edges.edges[i].from] = flat.vertices[edges.edges[i].to] = 1;
    for (std::size_t i = 0; i < edges.edges.size(); ++i)
        if (flat.edges[i] == 0)
            flat.vertices[edges.edges[i].from] = flat.vertices[edges.edges[i].to] = 0;
    return flat;
}

} // namespace chasles
