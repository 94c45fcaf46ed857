// Assembles a body from its parts: checks, outlines, edges, ownership and the BVH. Each part has its own file.
// The steps are in `make_body` at the end.
#include "chasles/mesh/make_body.h"

#include "chasles/base/flat_lists.h"
#include "chasles/base/invalid_input.h"
#include "chasles/mesh/collapsed_faces.h"
#include "chasles/mesh/face_outlines.h"
#include "chasles/mesh/flat_features.h"
#include "chasles/mesh/inward_parts.h"
#include "chasles/mesh/mesh_edges.h"
#include "chasles/mesh/ownership.h"
#include "chasles/mesh/polygon_faces.h"

#include <algorithm>
#include <utility>

namespace chasles {

namespace {

/// The number of distinct numbers in ascending order.
std::size_t count_distinct(std::vector<std::uint32_t> numbers) {
    return static_cast<std::size_t>(std::ranges::unique(numbers).begin() - numbers.begin());
}

/// Whether every face keeps its input id and no face is missing.
bool is_identity(const std::vector<std::uint32_t>& source, std::size_t given) {
    for (std::uint32_t face = 0; face < source.size(); ++face)
        if (source[face] != face)
            return false;
    return source.size() == given;
}

/// The edges that each face owns.
FlatLists<Edge> share_edges(const FlatLists<std::uint32_t>& outlines, const MeshEdges& edges,
                            const std::vector<char>& is_flat) {
    FlatLists<std::uint32_t> shares = share_features(outlines.offsets, edges.edge_of_side, is_flat);
    FlatLists<Edge> owned{std::move(shares.offsets), {}};
    owned.items.reserve(shares.items.size());
    for (const std::uint32_t edge : shares.items)
        owned.items.push_back(edges.edges[edge]);
    return owned;
}

/// The number of triangles if every polygon is cut.
std::size_t count_triangles(const PolygonFaces& polygons) {
    std::size_t triangles = polygons.triangles.items.size() / 3;
    for (std::size_t face = 0; face < polygons.faces.source.size(); ++face)
        if (polygons.triangles[face].empty())
            triangles += polygons.faces.outlines[face].size() - 2;
    return triangles;
}

/// The number of faces with more than three corners.
std::size_t count_polygons(const FlatLists<std::uint32_t>& outlines) {
    std::size_t polygons = 0;
    for (std::size_t face = 0; face < outlines.size(); ++face)
        polygons += outlines[face].size() > 3 ? 1 : 0;
    return polygons;
}

/// The greatest depth of a node; the root has depth 1. Children follow their parent, therefore one pass suffices.
std::size_t depth_of(std::span<const BvhNode> nodes) {
    std::vector<std::size_t> depths(nodes.size(), 1);
    for (std::size_t i = 0; i < nodes.size(); ++i)
        if (!nodes[i].is_leaf())
            depths[nodes[i].first] = depths[nodes[i].first + 1] = depths[i] + 1;
    return *std::ranges::max_element(depths);
}

/// Adds the bounding box: of all vertices that faces own, widened by the radius. It contains the flat vertices, which
/// no face owns.
void add_bounding_box(const BodyParts& parts, MeshReport& report) {
    Eigen::Vector3d lower = parts.vertices[parts.owned_vertices.items.front()];
    Eigen::Vector3d upper = lower;
    for (const std::uint32_t vertex : parts.owned_vertices.items) {
        lower = lower.cwiseMin(parts.vertices[vertex]);
        upper = upper.cwiseMax(parts.vertices[vertex]);
    }
    const Eigen::Vector3d radius = Eigen::Vector3d::Constant(report.radius);
    report.lower = lower - radius;
    report.upper = upper + radius;
}

/// Adds nodes, depth and bytes of the BVH.
void add_bvh(const Bvh& bvh, MeshReport& report) {
    report.bvh_nodes = bvh.nodes().size();
    report.bvh_depth = depth_of(bvh.nodes());
    report.bvh_bytes = bvh.memory();
}

/// Adds the parts of the surface and what they enclose.
void add_volume(BodyParts& parts, std::span<const UnpairedEdge> unpaired, Solid solid) {
    const Surface surface{parts.vertices, parts.outlines, unpaired, parts.bvh.centre()};
    parts.volume = find_volume(surface, solid);
    parts.report.parts = parts.volume.part_points.size();
    parts.report.inward_parts = count_inward_parts(surface, parts.volume);
    parts.report.solid_parts = parts.volume.solid_parts - parts.report.inward_parts;
    parts.report.unpaired_edges = parts.volume.unpaired_edges;
    parts.report.volume = signed_volume(surface, parts.volume);
    if (solid == Solid::yes && parts.report.volume < 0)
        throw InvalidInput(
            "mesh: solid: the surface is turned inwards, so it encloses a room and nothing in it is solid; "
            "reverse the corners of its faces, or leave solid at automatic");
}

/// The counts of faces and edges.
MeshReport make_report(const PolygonFaces& polygons, const MeshEdges& edges) {
    MeshReport report;
    report.faces = polygons.faces.source.size();
    report.triangles = count_triangles(polygons);
    report.polygons = count_polygons(polygons.faces.outlines);
    report.edges = edges.edges.size();
    report.boundary_edges = edges.boundary;
    report.nonmanifold_edges = edges.nonmanifold;
    return report;
}

/// The edges that the surface as it is given leaves open.
struct OpenEdges {
    bool have_boundary = false; ///< one of them has one face
    std::vector<UnpairedEdge> unpaired;
};

/// Faces without area that may close a gap between an edge and two edges that meet on it. Faces with two corners run
/// along their edge in both directions and close nothing.
FaceOutlines closing_faces(const FaceOutlines& collapsed, const MeshEdges& edges) {
    FaceOutlines closing;
    for (std::size_t face = 0; face < collapsed.source.size() && !edges.unpaired.empty(); ++face)
        if (collapsed.outlines[face].size() > 2)
            closing.append(collapsed.outlines[face], collapsed.source[face]);
    return closing;
}

OpenEdges open_edges(const FlatLists<std::uint32_t>& kept, const FlatLists<std::uint32_t>& closing,
                     const MeshEdges& edges, std::size_t vertex_count) {
    if (closing.size() == 0)
        return {edges.boundary > 0, edges.unpaired};
    FlatLists<std::uint32_t> given = kept;
    for (std::size_t face = 0; face < closing.size(); ++face)
        given.append(closing[face]);
    MeshEdges all = collect_edges(given, vertex_count);
    return {all.boundary > 0, std::move(all.unpaired)};
}

/// Adds the parts of faces without area that no edge covers, as segments behind the faces.
void keep_segments(std::span<const Eigen::Vector3d> vertices, PolygonFaces& polygons, MeshEdges& edges,
                   MeshReport& report) {
    const FaceOutlines segments = uncovered_segments(polygons.collapsed, polygons.faces.outlines, edges, vertices);
    edges.append_segments(segments.outlines);
    for (std::size_t i = 0; i < segments.source.size(); ++i)
        polygons.faces.append(segments.outlines[i], segments.source[i]);
    if (!polygons.triangles.offsets.empty())
        polygons.triangles.offsets.resize(polygons.faces.source.size() + 1, polygons.triangles.offsets.back());
    report.faces += segments.source.size();
    report.segments = segments.source.size();
    report.edges += segments.source.size();
    report.dropped_faces = polygons.collapsed.source.size() - count_distinct(segments.source);
}

} // namespace

BodyParts make_body(std::span<const Eigen::Vector3d> vertices, std::span<const std::span<const std::uint32_t>> faces,
                    const PolyhedronOptions& options) {
    check_vertices(vertices, options.radius > 0);
    SortedFaces sorted = sort_faces(vertices, faces, options.radius > 0);
    const std::size_t distinct_vertices = sorted.distinct_vertices;
    PolygonFaces polygons = examine_polygons(std::move(sorted), vertices, options);
    const FlatLists<std::uint32_t>& outlines = polygons.faces.outlines;
    MeshEdges edges = collect_edges(outlines, vertices.size());

    BodyParts parts;
    parts.report = make_report(polygons, edges);
    parts.closing = closing_faces(polygons.collapsed, edges);
    const OpenEdges open = open_edges(outlines, parts.closing.outlines, edges, vertices.size());
    parts.report.closed = !open.have_boundary;
    parts.report.vertices = vertices.size();
    parts.report.distinct_vertices = distinct_vertices;
    keep_segments(vertices, polygons, edges, parts.report);
    parts.vertices.assign(vertices.begin(), vertices.end());
    const FlatFeatures flat = find_flat_features(outlines, polygons.triangles, edges, vertices, options.threads);
    parts.owned_vertices = share_features(outlines.offsets, outlines.items, flat.vertices);
    parts.owned_edges = share_edges(outlines, edges, flat.edges);
    parts.bvh = Bvh(outlines, vertices, options.threads);
    if (flat.has_any)
        parts.bvh.mark_bare(
            [&](std::uint32_t face) { return parts.owned_vertices[face].empty() && parts.owned_edges[face].empty(); });
    if (!is_identity(polygons.faces.source, faces.size()))
        parts.source = std::move(polygons.faces.source);
    parts.triangles = std::move(polygons.triangles);
    parts.outlines = std::move(polygons.faces.outlines);
    parts.triangles.shrink();
    parts.outlines.shrink();
    add_volume(parts, open.unpaired, options.solid);
    parts.report.radius = options.radius;
    add_bounding_box(parts, parts.report);
    add_bvh(parts.bvh, parts.report);
    return parts;
}

BodyParts with_radius(BodyParts parts, double radius) {
    check_vertices(parts.vertices, radius > 0);
    if (parts.report.segments == parts.report.faces && radius == 0)
        refuse_without_area();
    parts.report.radius = radius;
    add_bounding_box(parts, parts.report);
    return parts;
}

} // namespace chasles
