// Bodies: from arrays, from the content of files, and back to arrays.
#include "chasles/io/mesh_bytes.h"
#include "chasles/io/text_scan.h"
#include "javascript/src/border.h"
#include "javascript/src/numbers_in.h"
#include "javascript/src/numbers_out.h"
#include "javascript/src/objects.h"

#include <cstring>

namespace chasles::javascript {

Handles<HeldBody>& bodies() {
    static Handles<HeldBody> held("polyhedron");
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

/// The faces in the bytes: the number of corners of each face, then the corners of all faces.
FlatLists<std::uint32_t> given_faces(std::uint32_t count) {
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
    return faces;
}

/// Whether no face was dropped or cut.
bool has_given_ids(const Polyhedron& polyhedron) {
    for (std::size_t face = 0; face < polyhedron.face_count(); ++face)
        if (polyhedron.source_face(face) != face)
            return false;
    return polyhedron.report().dropped_faces == 0;
}

PolyhedronOptions options_of(std::int32_t triangulate, std::int32_t solid, double radius) {
    if (solid < 0 || solid > std::int32_t(Solid::no))
        throw InvalidInput("solid: must be 'automatic', 'yes' or 'no'");
    return {.triangulate = triangulate != 0, .solid = Solid(solid), .radius = radius};
}

HeldBody held(Polyhedron shape, const PolyhedronOptions& options, FlatLists<std::uint32_t> faces) {
    if (has_given_ids(shape))
        faces = {};
    return {std::move(shape), options, std::move(faces)};
}

HeldBody body_from_arrays(std::uint32_t face_count, const PolyhedronOptions& options) {
    FlatLists<std::uint32_t> faces = given_faces(face_count);
    std::vector<std::span<const std::uint32_t>> outlines;
    for (std::size_t face = 0; face < faces.size(); ++face)
        outlines.push_back(faces[face]);
    return held(Polyhedron::from_outlines(given_points(), outlines, options), options, std::move(faces));
}

HeldBody body_from_file(std::uint32_t name_size, const PolyhedronOptions& options) {
    const std::string_view bytes = given_bytes();
    const std::string name = io::one_line(bytes.substr(0, name_size));
    const std::string_view content = bytes.substr(std::min<std::size_t>(name_size, bytes.size()));
    Polyhedron shape = io::read_polyhedron(content, name, options);
    FlatLists<std::uint32_t> faces;
    if (!has_given_ids(shape)) // reads it again, which is rare
        for (const auto& face : io::read_polygons(content, name).faces)
            faces.append(face);
    return held(std::move(shape), options, std::move(faces));
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

/// The number of corners of each face, then the corners of all faces.
void write_lists(Numbers& out, const FlatLists<std::uint32_t>& lists) {
    for (std::size_t list = 0; list < lists.size(); ++list)
        out.push_back(double(lists[list].size()));
    out.insert(out.end(), lists.items.begin(), lists.items.end());
}

FlatLists<std::uint32_t> outlines_of(const Polyhedron& shape) {
    FlatLists<std::uint32_t> outlines;
    for (std::size_t face = 0; face < shape.face_count(); ++face)
        outlines.append(shape.face(face));
    return outlines;
}

/// Triangles that cover the faces: three vertex ids each.
void write_triangles(Numbers& out, const Polyhedron& shape) {
    for (std::size_t face = 0; face < shape.face_count(); ++face)
        for (const auto& triangle : shape.triangles(face))
            out.insert(out.end(), triangle.begin(), triangle.end());
}

enum class Part : std::uint8_t { report, vertices, faces, triangles, source_faces, given };

void write_part(Numbers& out, const HeldBody& body, Part part) {
    switch (part) {
    case Part::report:
        return write_report(out, body.shape.report());
    case Part::vertices:
        return write_vertices(out, body.shape);
    case Part::faces:
        out.push_back(double(body.shape.face_count()));
        return write_lists(out, outlines_of(body.shape));
    case Part::triangles:
        return write_triangles(out, body.shape);
    case Part::source_faces:
        for (std::size_t face = 0; face < body.shape.face_count(); ++face)
            out.push_back(body.shape.source_face(face));
        return;
    case Part::given:
        break;
    }
    const bool is_as_given = body.given_faces.size() == 0;
    const FlatLists<std::uint32_t> faces = is_as_given ? outlines_of(body.shape) : body.given_faces;
    out.push_back(body.options.triangulate || body.options.radius < 0 ? 1 : 0); // as the moved faces were
    out.push_back(double(body.options.solid));
    out.push_back(body.shape.radius());
    out.push_back(double(faces.size()));
    write_lists(out, faces);
}

} // namespace
} // namespace chasles::javascript

namespace js = chasles::javascript;

/// A body of the points in the numbers and the faces in the bytes. Returns its handle.
CHASLES_JAVASCRIPT(body_from_arrays)(std::uint32_t face_count, std::int32_t triangulate, std::int32_t solid,
                                     double radius) {
    return js::guarded(
        [&] { return js::bodies().add(js::body_from_arrays(face_count, js::options_of(triangulate, solid, radius))); });
}

/// A body of a mesh file: the bytes are its name and its content. Returns its handle.
CHASLES_JAVASCRIPT(body_from_file)(std::uint32_t name_size, std::int32_t triangulate, std::int32_t solid, double radius) {
    return js::guarded(
        [&] { return js::bodies().add(js::body_from_file(name_size, js::options_of(triangulate, solid, radius))); });
}

/// Answers with a part of a body.
CHASLES_JAVASCRIPT(body_part)(std::int32_t body, std::int32_t part) {
    return js::answered([&](js::Numbers& out) {
        if (part < 0 || part > std::int32_t(js::Part::given))
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
