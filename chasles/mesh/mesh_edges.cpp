// Sorts the sides of faces into buckets by their lower vertex, then sorts each bucket by the higher vertex.
// This takes linear time for meshes of bounded valence.
#include "chasles/mesh/mesh_edges.h"

#include "chasles/base/sort.h"

#include <algorithm>
#include <numeric>

namespace chasles {
namespace {

/// A side of a face, stored at its lower vertex.
struct Side {
    std::uint32_t to;     ///< the higher vertex
    std::uint32_t corner; ///< index of its first corner in all outlines
    std::uint32_t face;
    bool is_upward; ///< runs from the lower to the higher vertex
};

/// Calls visit(corner, face, from, to) for every side of every face.
template <typename Visit>
void for_each_side(const FlatLists<std::uint32_t>& outlines, Visit visit) {
    for (std::uint32_t face = 0; face < outlines.size(); ++face) {
        const std::uint32_t begin = outlines.offsets[face];
        const std::uint32_t end = outlines.offsets[face + 1];
        for (std::uint32_t corner = begin; corner < end; ++corner)
            visit(corner, face, outlines.items[corner], outlines.items[corner + 1 == end ? begin : corner + 1]);
    }
}

/// The sides at each vertex, by a counting sort.
FlatLists<Side> sides_by_lower_vertex(const FlatLists<std::uint32_t>& outlines, std::size_t vertex_count) {
    FlatLists<Side> sides;
    sides.offsets.assign(vertex_count + 1, 0);
    for_each_side(outlines, [&](std::uint32_t, std::uint32_t, std::uint32_t from, std::uint32_t to) {
        ++sides.offsets[std::min(from, to) + 1];
    });
    std::partial_sum(sides.offsets.begin(), sides.offsets.end(), sides.offsets.begin());
    sides.items.resize(outlines.items.size());
    std::vector<std::uint32_t> next(sides.offsets.begin(), sides.offsets.end() - 1);
    for_each_side(outlines, [&](std::uint32_t corner, std::uint32_t face, std::uint32_t from, std::uint32_t to) {
        sides.items[next[std::min(from, to)]++] = {std::max(from, to), corner, face, from < to};
    });
    return sides;
}

/// The number of faces that have the edge of these sides. The sides are sorted by face. Opposite sides of one face
/// cancel.
std::size_t count_faces(std::span<const Side> sides) {
    std::size_t faces = 0;
    for (std::size_t begin = 0, end = 0; begin < sides.size(); begin = end) {
        int balance = 0;
        for (; end < sides.size() && sides[end].face == sides[begin].face; ++end)
            balance += sides[end].is_upward ? 1 : -1;
        faces += balance != 0 ? 1 : 0;
    }
    return faces;
}

/// Adds the edge of these sides, if a face has it.
void add_edge(std::uint32_t from, std::span<const Side> sides, MeshEdges& result) {
    const std::size_t faces = count_faces(sides);
    const bool is_edge = faces > 0;
    for (const Side& side : sides)
        result.edge_of_side[side.corner] = is_edge ? static_cast<std::uint32_t>(result.edges.size()) : MeshEdges::none;
    if (is_edge) {
        result.edges.push_back({from, sides.front().to});
        const bool has_two = faces == 2 && sides.size() == 2;
        result.two_faces.push_back(
            {has_two ? sides[0].face : MeshEdges::none, has_two ? sides[1].face : MeshEdges::none});
    }
    int surplus = 0;
    for (const Side& side : sides)
        surplus += side.is_upward ? 1 : -1;
    if (surplus != 0)
        result.unpaired.push_back({{from, sides.front().to}, surplus});
    result.boundary += faces == 1 ? 1 : 0;
    result.nonmanifold += faces > 2 ? 1 : 0;
}

} // namespace

std::span<const Edge> MeshEdges::edges_from(std::uint32_t vertex) const {
    const auto found = std::ranges::equal_range(edges, vertex, {}, &Edge::from);
    return {found.begin(), found.end()};
}

void MeshEdges::append_segments(const FlatLists<std::uint32_t>& outlines) {
    for (std::size_t face = 0; face < outlines.size(); ++face) {
        const auto edge = static_cast<std::uint32_t>(edges.size());
        edge_of_side.insert(edge_of_side.end(), {edge, none, none});
        edges.push_back({outlines[face][0], outlines[face][1]});
        two_faces.push_back({none, none});
    }
}

MeshEdges collect_edges(const FlatLists<std::uint32_t>& outlines, std::size_t vertex_count) {
    FlatLists<Side> sides = sides_by_lower_vertex(outlines, vertex_count);
    MeshEdges result;
    result.edge_of_side.resize(outlines.items.size());
    result.edges.reserve(outlines.items.size() / 2 + 1);
    result.two_faces.reserve(outlines.items.size() / 2 + 1);
    for (std::uint32_t from = 0; from < vertex_count; ++from) {
        const std::span<Side> bucket(sides.items.data() + sides.offsets[from],
                                     sides.items.data() + sides.offsets[from + 1]);
        chasles::sort(bucket, [](const Side& a, const Side& b) {
            return a.to != b.to ? a.to < b.to : a.corner < b.corner; // corners ascend with faces
        });
        for (std::size_t begin = 0, end = 0; begin < bucket.size(); begin = end) {
            while (end < bucket.size() && bucket[end].to == bucket[begin].to)
                ++end;
            add_edge(from, bucket.subspan(begin, end - begin), result);
        }
    }
    return result;
}

} // namespace chasles
