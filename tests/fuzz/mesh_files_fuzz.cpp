// Any byte sequence as OBJ, OFF, PLY and STL: each reader reads or refuses it, and the mesh makes a body or is refused.
#include "chasles/base/invalid_input.h"
#include "chasles/io/mesh_files.h"
#include "chasles/mesh/body.h"
#include "tests/fuzz/bytes.h"

#include <algorithm>

namespace chasles::fuzz {
namespace {

void demand_sound(const io::PolygonSoup& soup) {
    for (const Eigen::Vector3d& vertex : soup.vertices)
        demand(vertex.allFinite(), "coordinates that are read are finite");
    for (const auto& face : soup.faces)
        for (const std::uint32_t vertex : face)
            demand(vertex < soup.vertices.size(), "indices that are read are in range");
    demand(soup.face_lines.empty() || soup.face_lines.size() == soup.faces.size(), "each face has a line, or none");
}

void demand_sound(const Polyhedron& body, const io::PolygonSoup& soup) {
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
    demand(report.closed == (report.boundary_edges == 0), "closed is without a boundary");
    demand(body.body().bvh().nodes().size() == 2 * body.face_count() - 1, "every face has its box");
}

void make_body(const io::PolygonSoup& soup, const PolyhedronOptions& options) {
    try {
        demand_sound(Polyhedron::from_polygons(soup.vertices, soup.faces, options), soup);
    } catch (const InvalidInput&) { // refused, which is an answer
    }
}

void read_with(io::PolygonSoup (*read)(std::string_view), std::string_view text) {
    try {
        const io::PolygonSoup soup = read(text);
        demand_sound(soup);
        make_body(soup, {});
        make_body(soup, {.triangulate = true, .drop_degenerate = true});
    } catch (const InvalidInput&) { // refused, which is an answer
    }
}

} // namespace
} // namespace chasles::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view text = chasles::fuzz::text_of(data, size);
    for (const auto read : {chasles::io::read_obj, chasles::io::read_off, chasles::io::read_ply, chasles::io::read_stl})
        chasles::fuzz::read_with(read, text);
    return 0;
}
