// The distinct corners of a collapsed face divide its line into segments. Edges of other faces must cover all segments.
// Corners are compared exactly.
#include "chasles/mesh/collapsed_faces.h"

#include "chasles/base/invalid_input.h"

#include <algorithm>
#include <string>
#include <tuple>

namespace chasles {
namespace {

/// The distinct corners, ordered by coordinates. For points of one line this is the order along the line.
std::vector<std::uint32_t> corners_along_line(std::span<const std::uint32_t> outline,
                                              std::span<const Eigen::Vector3d> vertices) {
    std::vector<std::uint32_t> corners(outline.begin(), outline.end());
    const auto place = [&](std::uint32_t corner) {
        const Eigen::Vector3d& point = vertices[corner];
        return std::tuple(point.x(), point.y(), point.z());
    };
    std::ranges::sort(corners, {}, place);
    corners.erase(std::ranges::unique(corners).begin(), corners.end());
    return corners;
}

/// Whether edges cover the line from the first to the last corner. Extends the covered part by edges that begin in it.
bool is_covered_by(const MeshEdges& edges, std::span<const std::uint32_t> corners) {
    std::size_t covered = 0;
    for (std::size_t begin = 0; begin <= covered && begin < corners.size(); ++begin)
        for (std::size_t end = corners.size() - 1; end > covered; --end)
            if (edges.contains(corners[begin], corners[end]))
                covered = end;
    return covered + 1 == corners.size();
}

/// A flag for each vertex: whether an outline contains it.
std::vector<bool> vertices_of(const FlatLists<std::uint32_t>& outlines, std::size_t vertex_count) {
    std::vector<bool> is_used(vertex_count, false);
    for (const std::uint32_t vertex : outlines.items)
        is_used[vertex] = true;
    return is_used;
}

} // namespace

void check_covered(const FaceOutlines& collapsed, const FlatLists<std::uint32_t>& kept, const MeshEdges& edges,
                   std::span<const Eigen::Vector3d> vertices) {
    if (collapsed.source.empty())
        return;
    const std::vector<bool> is_kept = vertices_of(kept, vertices.size());
    for (std::size_t i = 0; i < collapsed.source.size(); ++i) {
        const std::vector<std::uint32_t> corners = corners_along_line(collapsed.outlines[i], vertices);
        if (!is_kept[corners.front()] || !is_covered_by(edges, corners))
            throw InvalidInput("face " + std::to_string(collapsed.source[i]) + ": has no area (" +
                               (corners.size() < 3 ? "its vertices coincide" : "its vertices lie on one line") +
                               ") and is no part of other faces' edges");
    }
}

} // namespace chasles
