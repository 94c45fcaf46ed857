// The surface is drawn as triangles. Lines are drawn only along edges of the body, never along the diagonals of a face.
#include "view/drawn_mesh.h"

#include "view/round_surface.h"

#include <algorithm>
#include <cmath>

namespace chasles::view {
namespace {

using Triangle = std::array<std::uint32_t, 3>;

/// An edge of one face.
struct FaceEdge {
    std::array<std::uint32_t, 2> ends;
    std::uint32_t face;
    bool is_upward; ///< whether the face's outline runs from the lower vertex id to the higher one
};

// Newell's sum over the outline. For a polygon that is only nearly planar, this sum is an average normal.
Eigen::Vector3d unit_normal(const Polyhedron& body, std::size_t face) {
    const auto outline = body.face(face);
    const Eigen::Vector3d first = body.vertices()[outline[0]];
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (std::size_t i = 1; i + 1 < outline.size(); ++i)
        sum += (body.vertices()[outline[i]] - first).cross(body.vertices()[outline[i + 1]] - first);
    return sum.stableNormalized();
}

std::vector<FaceEdge> sorted_edges(const Polyhedron& body) {
    std::vector<FaceEdge> edges;
    for (std::uint32_t face = 0; face < body.face_count(); ++face) {
        const auto outline = body.face(face);
        for (std::size_t i = 0; i < outline.size(); ++i) {
            const std::uint32_t from = outline[i];
            const std::uint32_t to = outline[(i + 1) % outline.size()];
            edges.push_back({{std::min(from, to), std::max(from, to)}, face, from < to});
        }
    }
    std::sort(edges.begin(), edges.end(), [](const FaceEdge& a, const FaceEdge& b) { return a.ends < b.ends; });
    return edges;
}

// An edge is a crease unless exactly two faces share it and turn by less than least_crease there. If both outlines run
// along the edge in the same direction, one face has the opposite orientation and its normal points inward.
bool is_crease(const Polyhedron& body, std::span<const FaceEdge> sharing) {
    if (sharing.size() != 2)
        return true;
    const double cosine = unit_normal(body, sharing[0].face).dot(unit_normal(body, sharing[1].face));
    const bool is_wound_alike = sharing[0].is_upward != sharing[1].is_upward;
    return !((is_wound_alike ? cosine : -cosine) > std::cos(least_crease));
}

std::vector<std::array<std::uint32_t, 2>> creases(const Polyhedron& body) {
    const std::vector<FaceEdge> edges = sorted_edges(body);
    std::vector<std::array<std::uint32_t, 2>> found;
    for (std::size_t first = 0, end = 0; first < edges.size(); first = end) {
        while (end < edges.size() && edges[end].ends == edges[first].ends)
            ++end;
        if (is_crease(body, std::span(edges).subspan(first, end - first)))
            found.push_back(edges[first].ends);
    }
    return found;
}

} // namespace

DrawnMesh drawn_mesh(const Polyhedron& body) {
    DrawnMesh drawn;
    Eigen::AlignedBox3d box;
    for (const Eigen::Vector3d& vertex : body.vertices())
        box.extend(vertex);
    drawn.origin = box.center();
    for (const Eigen::Vector3d& vertex : body.vertices()) {
        const Eigen::Vector3f about_origin = (vertex - drawn.origin).cast<float>();
        drawn.vertices.push_back({about_origin.x(), about_origin.y(), about_origin.z()});
    }
    if (body.radius() > 0) {
        add_round_surface(drawn, body);
        return drawn;
    }
    for (std::size_t face = 0; face < body.face_count(); ++face)
        for (const Triangle& triangle : body.triangles(face))
            drawn.triangles.push_back(triangle);
    drawn.creases = creases(body);
    return drawn;
}

} // namespace chasles::view
