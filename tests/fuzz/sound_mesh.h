// What holds for every mesh that a reader returns, and for the body that is made of it.
#pragma once

#include "chasles/base/invalid_input.h"
#include "chasles/io/mesh_files.h"
#include "chasles/mesh/body.h"
#include "tests/fuzz/bytes.h"

namespace chasles::fuzz {

inline void demand_sound(const io::PolygonSoup& soup) {
    for (const Eigen::Vector3d& vertex : soup.vertices)
        demand(vertex.allFinite(), "coordinates that are read are finite");
    for (const auto& face : soup.faces)
        for (const std::uint32_t vertex : face)
            demand(vertex < soup.vertices.size(), "indices that are read are in range");
    demand(soup.face_lines.empty() || soup.face_lines.size() == soup.faces.size(), "each face has a line, or none");
}

inline void demand_sound(const Polyhedron& body, const io::PolygonSoup& soup) {
    const MeshReport report = body.report();
    std::size_t edges = 0;
    for (std::uint32_t face = 0; face < body.face_count(); ++face) {
        edges += body.body().owned_edges(face).size();
        demand(body.face(face).size() >= 3, "faces have three corners at least");
        demand(body.source_face(face) < soup.faces.size(), "faces come from the input");
        for (const std::uint32_t corner : body.face_triangles(face))
            demand(corner < body.face(face).size(), "triangles are made of the corners of their face");
    }
    demand(edges > 0 && edges <= report.edges, "every edge that is not flat is owned once");
    demand(report.dropped_faces > 0 || report.closed == (report.boundary_edges == 0),
           "closed is without a boundary, but for faces that were dropped");
    demand(body.body().bvh().nodes().size() == 2 * body.face_count() - 1, "every face has its box");
}

inline void make_body(const io::PolygonSoup& soup, const PolyhedronOptions& options) {
    try {
        demand_sound(Polyhedron::from_polygons(soup.vertices, soup.faces, options), soup);
    } catch (const InvalidInput&) { // refused, which is an answer
    }
}

/// Reads, which may be refused, and makes bodies of what is read.
template <typename Read>
void read_or_refuse(const Read& read) {
    try {
        const io::PolygonSoup soup = read();
        demand_sound(soup);
        if (soup.faces.size() > 10'000) // a few nodes can place a mesh a million times, which takes long
            return;
        make_body(soup, {});
        make_body(soup, {.triangulate = true});
    } catch (const InvalidInput&) { // refused, which is an answer
    }
}

} // namespace chasles::fuzz
