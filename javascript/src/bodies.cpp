// Bodies: from arrays, from the content of files, and back to arrays.
#include "chasles/base/flat_lists.h"
#include "chasles/io/mesh_bytes.h"
#include "chasles/io/text_scan.h"
#include "javascript/src/border.h"
#include "javascript/src/numbers_in.h"
#include "javascript/src/numbers_out.h"
#include "javascript/src/objects.h"

#include <cstring>

namespace chasles::javascript {

Handles<Polyhedron>& bodies() {
    static Handles<Polyhedron> held("polyhedron");
    return held;
}

namespace {

/// The points in the numbers. Throws InvalidInput if they are not triples.
std::span<const Eigen::Vector3d> given_points() {
    static_assert(sizeof(Eigen::Vector3d) == 3 * sizeof(double));
    const auto numbers = given_numbers();
    if (numbers.size() % 3 != 0)
        throw InvalidInput("vertices: " + std::to_string(numbers.size()) + " numbers are no points of 3 numbers each");
    return {reinterpret_cast<const Eigen::Vector3d*>(numbers.data()), numbers.size() / 3};
}

/// The faces in the bytes: the number of corners of each face, then the corners of all faces; and the numbers after them.
struct GivenFaces {
    FlatLists<std::uint32_t> faces;
    std::vector<std::uint32_t> rest;
};

GivenFaces given_faces(std::uint32_t count) {
    const std::string_view bytes = given_bytes();
    const std::size_t size = bytes.size() / sizeof(std::uint32_t);
    if (count > size)
        throw InvalidInput("faces: there are too few numbers");
    std::vector<std::uint32_t> numbers(size);
    std::memcpy(numbers.data(), bytes.data(), size * sizeof(std::uint32_t));
    std::span<const std::uint32_t> corners = std::span(numbers).subspan(count);
    FlatLists<std::uint32_t> faces;
    for (std::uint32_t face = 0; face < count; ++face) {
        if (numbers[face] > corners.size())
            throw InvalidInput("faces[" + std::to_string(face) + "]: there are too few numbers");
        faces.append(corners.first(numbers[face]));
        corners = corners.subspan(numbers[face]);
    }
    return {std::move(faces), {corners.begin(), corners.end()}};
}

PolyhedronOptions options_of(std::int32_t triangulate, std::int32_t solid, double radius) {
    if (solid < 0 || solid > std::int32_t(Solid::no))
        throw InvalidInput("solid: must be 'automatic', 'yes' or 'no'");
    return {.triangulate = triangulate != 0, .solid = Solid(solid), .radius = radius};
}

Polyhedron body_of(const FlatLists<std::uint32_t>& faces, const PolyhedronOptions& options) {
    std::vector<std::span<const std::uint32_t>> outlines;
    for (std::size_t face = 0; face < faces.size(); ++face)
        outlines.push_back(faces[face]);
    return Polyhedron::from_outlines(given_points(), outlines, options);
}

Polyhedron body_from_file(std::uint32_t name_size, const PolyhedronOptions& options) {
    const std::string_view bytes = given_bytes();
    const std::string name = io::one_line(bytes.substr(0, name_size));
    return io::read_polyhedron(bytes.substr(std::min<std::size_t>(name_size, bytes.size())), name, options);
}

void write_report(Numbers& out, const MeshReport& report) {
    for (const std::size_t count :
         {report.vertices, report.distinct_vertices, report.faces, report.triangles, report.polygons, report.edges,
          report.boundary_edges, report.nonmanifold_edges, report.dropped_faces, report.segments})
        out.push_back(double(count));
    out.push_back(report.closed ? 1 : 0);
    for (const std::size_t count : {report.unpaired_edges, report.parts, report.solid_parts, report.inward_parts})
        out.push_back(double(count));
    for (const double number : {report.volume, report.radius, report.moved_inwards})
        out.push_back(number);
    write(out, report.lower);
    write(out, report.upper);
}

void write_vertices(Numbers& out, const Polyhedron& shape) {
    for (const Eigen::Vector3d& vertex : shape.vertices())
        write(out, vertex);
}

/// The number of faces, the number of corners of each face, then the corners of all faces.
void write_faces(Numbers& out, const Polyhedron& shape) {
    const auto outlines = shape.outlines();
    out.push_back(double(outlines.size()));
    for (const auto outline : outlines)
        out.push_back(double(outline.size()));
    for (const auto outline : outlines)
        out.insert(out.end(), outline.begin(), outline.end());
}

/// Triangles that cover the faces: three vertex ids each.
void write_triangles(Numbers& out, const Polyhedron& shape) {
    for (std::size_t face = 0; face < shape.face_count(); ++face)
        for (const auto& triangle : shape.triangles(face))
            out.insert(out.end(), triangle.begin(), triangle.end());
}

enum class Part : std::uint8_t { report, vertices, faces, triangles, source_faces };

void write_part(Numbers& out, const Polyhedron& shape, Part part) {
    switch (part) {
    case Part::report:
        return write_report(out, shape.report());
    case Part::vertices:
        return write_vertices(out, shape);
    case Part::faces:
        return write_faces(out, shape);
    case Part::triangles:
        return write_triangles(out, shape);
    case Part::source_faces:
        for (std::size_t face = 0, count = shape.outlines().size(); face < count; ++face)
            out.push_back(shape.source_face(face));
    }
}

} // namespace
} // namespace chasles::javascript

namespace js = chasles::javascript;

/// A body of the points in the numbers and the faces in the bytes. Returns its handle.
CHASLES_JAVASCRIPT(body_from_arrays)(std::uint32_t face_count, std::int32_t triangulate, std::int32_t solid,
                                     double radius) {
    return js::guarded([&] {
        return js::bodies().add(
            js::body_of(js::given_faces(face_count).faces, js::options_of(triangulate, solid, radius)));
    });
}

/// A copy of a body, from its points in the numbers, and its faces in the bytes with their ids behind them. Returns its
/// handle.
CHASLES_JAVASCRIPT(body_again)(std::uint32_t face_count, std::int32_t solid, double radius, double moved_inwards) {
    return js::guarded([&] {
        const js::GivenFaces given = js::given_faces(face_count);
        return js::bodies().add(
            js::body_of(given.faces, js::options_of(0, solid, radius)).with_sources(given.rest, moved_inwards));
    });
}

/// A body of a mesh file: the bytes are its name and its content. Returns its handle.
CHASLES_JAVASCRIPT(body_from_file)(std::uint32_t name_size, std::int32_t triangulate, std::int32_t solid, double radius) {
    return js::guarded(
        [&] { return js::bodies().add(js::body_from_file(name_size, js::options_of(triangulate, solid, radius))); });
}

/// Answers with a part of a body.
CHASLES_JAVASCRIPT(body_part)(std::int32_t body, std::int32_t part) {
    return js::answered([&](js::Numbers& out) {
        if (part < 0 || part > std::int32_t(js::Part::source_faces))
            throw chasles::InvalidInput("polyhedron: there is no such part");
        js::write_part(out, js::bodies().get(body), js::Part(part));
    });
}

CHASLES_JAVASCRIPT(free_body)(std::int32_t body) {
    return js::guarded([&] { return js::bodies().free(body), 0; });
}

/// The numbers of bodies, of scenes and of bodies in a hand that are not freed.
CHASLES_JAVASCRIPT(held)(std::int32_t kind) {
    return js::guarded([&] {
        return kind == 0 ? js::bodies().size() : kind == 1 ? js::scenes().size() : js::hands().size();
    });
}
