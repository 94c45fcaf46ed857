// The distinct corners of a collapsed face divide its line into pieces. An edge of a kept face between two of the
// corners covers the pieces between them. CornerIds are compared exactly.
#include "chasles/mesh/collapsed_faces.h"

#include "chasles/base/sort.h"

#include <algorithm>
#include <array>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

namespace chasles {
namespace {

using CornerIds = std::vector<std::uint32_t>;

/// The distinct corners, ordered by coordinates. For points of one line this is the order along the line.
CornerIds corners_along_line(std::span<const std::uint32_t> outline, std::span<const Eigen::Vector3d> vertices) {
    CornerIds corners(outline.begin(), outline.end());
    const auto place = [&](std::uint32_t corner) {
        const Eigen::Vector3d& point = vertices[corner];
        return std::tuple(point.x(), point.y(), point.z());
    };
    chasles::sort(corners, {}, place);
    corners.erase(std::ranges::unique(corners).begin(), corners.end());
    return corners;
}

/// Finds the edges between the corners of one line.
class EdgesOnLine {
public:
    EdgesOnLine(const MeshEdges& edges, const CornerIds& corners) : edges_(edges), corners_(corners) {
        for (std::uint32_t place = 0; place < corners.size(); ++place)
            places_.emplace_back(corners[place], place);
        chasles::sort(places_);
    }

    /// For each corner: the last corner that an edge from a corner up to this one reaches.
    [[nodiscard]] std::vector<std::uint32_t> farthest() const {
        std::vector<std::uint32_t> farthest(corners_.size(), 0);
        for (const auto& [corner, place] : places_)
            for (const Edge& edge : edges_.edges_from(corner))
                if (const auto other = place_of(edge.to))
                    farthest[std::min(place, *other)] =
                        std::max(farthest[std::min(place, *other)], std::max(place, *other));
        for (std::size_t i = 1; i < farthest.size(); ++i)
            farthest[i] = std::max(farthest[i], farthest[i - 1]);
        return farthest;
    }

private:
    using Place = std::pair<std::uint32_t, std::uint32_t>; ///< a corner and its position on the line

    [[nodiscard]] std::optional<std::uint32_t> place_of(std::uint32_t vertex) const {
        const auto found = std::ranges::lower_bound(places_, vertex, {}, &Place::first);
        return found != places_.end() && found->first == vertex ? std::optional(found->second) : std::nullopt;
    }

    const MeshEdges& edges_;
    const CornerIds& corners_;
    std::vector<Place> places_;
};

/// Collects segments, each once, and points that no face contains, likewise.
class Segments {
public:
    explicit Segments(std::vector<bool> is_used) : is_used_(std::move(is_used)) {}
    void add(std::uint32_t a, std::uint32_t b, std::uint32_t source) {
        const auto [from, to] = std::minmax(a, b);
        if (known_.emplace(from, to).second)
            outlines_.append(std::array{from, to, to}, source);
    }
    void add_point(std::uint32_t vertex, std::uint32_t source) {
        if (!is_used_[vertex])
            outlines_.append(std::array{vertex, vertex, vertex}, source);
        is_used_[vertex] = true;
    }
    [[nodiscard]] FaceOutlines take() { return std::move(outlines_); }

private:
    std::vector<bool> is_used_; ///< a flag for each vertex
    std::set<std::pair<std::uint32_t, std::uint32_t>> known_;
    FaceOutlines outlines_;
};

/// A flag for each vertex: whether an outline contains it.
std::vector<bool> vertices_of(const FlatLists<std::uint32_t>& outlines, std::size_t vertex_count) {
    std::vector<bool> is_used(vertex_count, false);
    for (const std::uint32_t vertex : outlines.items)
        is_used[vertex] = true;
    return is_used;
}

} // namespace

FaceOutlines uncovered_segments(const FaceOutlines& collapsed, const FlatLists<std::uint32_t>& kept,
                                const MeshEdges& edges, std::span<const Eigen::Vector3d> vertices) {
    if (collapsed.source.empty())
        return {};
    Segments segments(vertices_of(kept, vertices.size()));
    for (std::size_t i = 0; i < collapsed.source.size(); ++i) {
        const std::uint32_t source = collapsed.source[i];
        const CornerIds corners = corners_along_line(collapsed.outlines[i], vertices);
        if (corners.size() == 1) {
            segments.add_point(corners.front(), source);
            continue;
        }
        const std::vector<std::uint32_t> farthest = EdgesOnLine(edges, corners).farthest();
        for (std::size_t piece = 0; piece + 1 < corners.size(); ++piece)
            if (farthest[piece] <= piece)
                segments.add(corners[piece], corners[piece + 1], source);
    }
    return segments.take();
}

} // namespace chasles
