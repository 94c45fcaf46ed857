// A polyhedron is put together here: checks, outlines, edges, ownership and boxes, each made in its own file.
#include "chasles/mesh/polyhedron.h"

#include "chasles/invalid_input.h"
#include "chasles/mesh/collapsed_faces.h"
#include "chasles/mesh/face_outlines.h"
#include "chasles/mesh/flat_lists.h"
#include "chasles/mesh/mesh_edges.h"
#include "chasles/mesh/ownership.h"
#include "chasles/mesh/polygon_faces.h"

#include <mutex>
#include <numeric>
#include <utility>

namespace chasles {

struct Polyhedron::Data {
    std::vector<Eigen::Vector3d> vertices;
    FlatLists<std::uint32_t> outlines;
    std::vector<std::uint32_t> source; // none where every face is numbered as it was given
    FlatLists<std::uint32_t> triangles;
    FlatLists<std::uint32_t> owned_vertices;
    FlatLists<Edge> owned_edges;
    BoxHierarchy hierarchy;
    MeshReport report;
    mutable std::once_flag surroundings_once;
    mutable FlatLists<std::uint32_t> surroundings; // faces around each vertex, made when they are first asked for
};

namespace {

bool is_identity(const std::vector<std::uint32_t>& source, std::size_t given) {
    for (std::uint32_t face = 0; face < source.size(); ++face)
        if (source[face] != face)
            return false;
    return source.size() == given;
}

/// For each corner that occurs, the lists that have it, each once.
FlatLists<std::uint32_t> lists_with(const FlatLists<std::uint32_t>& outlines, std::size_t corner_count) {
    const auto for_each = [&](auto visit) {
        std::vector<std::uint32_t> last(corner_count, 0); // number of the last list that had it, plus one
        for (std::uint32_t list = 0; list < outlines.size(); ++list)
            for (const std::uint32_t corner : outlines[list])
                if (std::exchange(last[corner], list + 1) != list + 1)
                    visit(corner, list);
    };
    FlatLists<std::uint32_t> lists;
    lists.offsets.assign(corner_count + 1, 0);
    for_each([&](std::uint32_t corner, std::uint32_t) { ++lists.offsets[corner + 1]; });
    std::partial_sum(lists.offsets.begin(), lists.offsets.end(), lists.offsets.begin());
    lists.items.resize(lists.offsets.back());
    std::vector<std::uint32_t> next(lists.offsets.begin(), lists.offsets.end() - 1);
    for_each([&](std::uint32_t corner, std::uint32_t list) { lists.items[next[corner]++] = list; });
    return lists;
}

FlatLists<Edge> share_edges(const FlatLists<std::uint32_t>& outlines, const MeshEdges& edges) {
    FlatLists<std::uint32_t> shares = share_features(outlines.offsets, edges.edge_of_side, edges.edges.size());
    FlatLists<Edge> owned{std::move(shares.offsets), {}};
    owned.items.reserve(shares.items.size());
    for (const std::uint32_t edge : shares.items)
        owned.items.push_back(edges.edges[edge]);
    return owned;
}

std::size_t count_triangles(const PolygonFaces& polygons) {
    std::size_t triangles = polygons.triangles.items.size() / 3;
    for (std::size_t face = 0; face < polygons.faces.source.size(); ++face)
        if (polygons.triangles[face].empty())
            triangles += polygons.faces.outlines[face].size() - 2;
    return triangles;
}

std::size_t count_polygons(const FlatLists<std::uint32_t>& outlines) {
    std::size_t polygons = 0;
    for (std::size_t face = 0; face < outlines.size(); ++face)
        polygons += outlines[face].size() > 3 ? 1 : 0;
    return polygons;
}

MeshReport make_report(const PolygonFaces& polygons, const MeshEdges& edges) {
    MeshReport report;
    report.faces = polygons.faces.source.size();
    report.triangles = count_triangles(polygons);
    report.polygons = count_polygons(polygons.faces.outlines);
    report.edges = edges.edges.size();
    report.boundary_edges = edges.boundary;
    report.nonmanifold_edges = edges.nonmanifold;
    report.closed = edges.boundary == 0;
    return report;
}

} // namespace

Polyhedron Polyhedron::from_polygons(std::span<const Eigen::Vector3d> vertices,
                                     std::span<const std::vector<std::uint32_t>> faces,
                                     const PolyhedronOptions& options) {
    const std::vector<std::span<const std::uint32_t>> looked_at(faces.begin(), faces.end());
    return from_outlines(vertices, looked_at, options);
}

Polyhedron Polyhedron::from_outlines(std::span<const Eigen::Vector3d> vertices,
                                     std::span<const std::span<const std::uint32_t>> faces,
                                     const PolyhedronOptions& options) {
    check_vertices(vertices);
    SortedFaces sorted = sort_faces(vertices, faces, options);
    PolygonFaces polygons = examine_polygons(std::move(sorted.proper), vertices, options);
    const FlatLists<std::uint32_t>& outlines = polygons.faces.outlines;
    const MeshEdges edges = collect_edges(outlines, vertices.size());
    check_covered(sorted.collapsed, outlines, edges, vertices);

    auto data = std::make_shared<Data>();
    data->report = make_report(polygons, edges);
    data->report.vertices = vertices.size();
    data->report.distinct_vertices = sorted.distinct_vertices;
    data->report.dropped_faces = sorted.collapsed.source.size();
    data->vertices.assign(vertices.begin(), vertices.end());
    data->owned_vertices = share_features(outlines.offsets, outlines.items, vertices.size());
    data->owned_edges = share_edges(outlines, edges);
    data->hierarchy = BoxHierarchy(outlines, vertices, options.threads);
    if (!is_identity(polygons.faces.source, faces.size()))
        data->source = std::move(polygons.faces.source);
    data->triangles = std::move(polygons.triangles);
    data->outlines = std::move(polygons.faces.outlines);
    data->triangles.shrink();
    data->outlines.shrink();
    return Polyhedron(std::move(data));
}

Polyhedron::Polyhedron(std::shared_ptr<const Data> data) : data_(std::move(data)) {}

std::size_t Polyhedron::vertex_count() const {
    return data_->vertices.size();
}

std::size_t Polyhedron::face_count() const {
    return data_->outlines.size();
}

std::span<const Eigen::Vector3d> Polyhedron::vertices() const {
    return data_->vertices;
}

std::span<const std::uint32_t> Polyhedron::face(std::size_t face) const {
    return data_->outlines[face];
}

std::uint32_t Polyhedron::source_face(std::size_t face) const {
    return data_->source.empty() ? static_cast<std::uint32_t>(face) : data_->source[face];
}

std::span<const std::uint32_t> Polyhedron::face_triangles(std::size_t face) const {
    return data_->triangles[face];
}

std::span<const std::uint32_t> Polyhedron::owned_vertices(std::size_t face) const {
    return data_->owned_vertices[face];
}

std::span<const Edge> Polyhedron::owned_edges(std::size_t face) const {
    return data_->owned_edges[face];
}

std::span<const std::uint32_t> Polyhedron::faces_around(std::size_t vertex) const {
    std::call_once(data_->surroundings_once,
                   [&] { data_->surroundings = lists_with(data_->outlines, data_->vertices.size()); });
    return data_->surroundings[vertex];
}

const BoxHierarchy& Polyhedron::hierarchy() const {
    return data_->hierarchy;
}

MeshReport Polyhedron::report() const {
    return data_->report;
}

std::size_t Polyhedron::memory() const {
    return sizeof(Data) + data_->outlines.memory() + data_->source.capacity() * sizeof(std::uint32_t) +
           data_->triangles.memory() + data_->owned_vertices.memory() + data_->owned_edges.memory() +
           data_->hierarchy.memory();
}

} // namespace chasles
