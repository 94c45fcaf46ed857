// chasles.Polyhedron: from arrays, from files, and back to arrays.
#include "chasles/base/invalid_input.h"
#include "chasles/io/mesh_files.h"
#include "chasles/mesh/primitives.h"
#include "python/src/arrays.h"
#include "python/src/bind.h"
#include "python/src/body.h"
#include "python/src/docstrings.h"
#include "python/src/face_lists.h"
#include "python/src/names.h"
#include "python/src/query_options.h"
#include "python/src/without_gil.h"

#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>
#include <numeric>

namespace chasles::python {
namespace {

using namespace nb::literals;

static_assert(sizeof(Eigen::Vector3d) == 3 * sizeof(double)); // the rows of a NumPy array are used as points

/// Points of the shape (n, 3).
class Points {
public:
    Points(nb::handle argument, const char* name) : array_(argument, name) {
        if (array_.shape().size() != 2 || array_.shape()[1] != 3)
            throw InvalidInput(std::string(name) + ": the shape is " + array_.shape_text() +
                               "; points have (n, 3), as in [[0, 0, 0], [1, 0, 0], [0, 1, 0]]");
    }
    [[nodiscard]] std::span<const Eigen::Vector3d> span() const {
        return {reinterpret_cast<const Eigen::Vector3d*>(array_.numbers().data()), array_.numbers().size() / 3};
    }

private:
    DoubleArray array_;
};

Body points(nb::handle argument, double radius) {
    const Points given(argument, "points");
    const WithoutGil without_gil;
    return {make_points(given.span(), radius)};
}

template <auto Make, class... Lengths>
Body made(Lengths... lengths) {
    return {Make(lengths...)};
}

Body body_from(nb::handle vertices, nb::handle faces, const PolyhedronOptions& options) {
    const Points points(vertices, "vertices");
    const FaceLists outlines(faces);
    const std::span given = points.span();
    const WithoutGil without_gil;
    return {Polyhedron::from_outlines(given, outlines.lists(), options), options.threads};
}

Body load(const std::filesystem::path& file, bool triangulate, unsigned threads, nb::handle solid, double radius) {
    const PolyhedronOptions options{triangulate, threads, solid_from(solid), radius};
    const WithoutGil without_gil;
    return {Polyhedron::load(file, options), threads};
}

nb::dict load_parts(const std::filesystem::path& file, bool triangulate, unsigned threads, nb::handle solid,
                    double radius) {
    const PolyhedronOptions options{triangulate, threads, solid_from(solid), radius};
    std::vector<std::pair<std::string, Body>> bodies;
    {
        const WithoutGil without_gil;
        for (const io::MeshPart& part : io::load_mesh_parts(file))
            bodies.emplace_back(part.name, Body{io::body_of(file, part, options), threads});
    }
    nb::dict parts;
    for (auto& [name, body] : bodies)
        parts[nb::str(name.c_str(), name.size())] = nb::cast(std::move(body));
    return parts;
}

nb::object vertices(nb::handle self) {
    const auto points = polyhedron_of(self, "self").vertices();
    using View = nb::ndarray<nb::numpy, const double>;
    return nb::cast(View(points.data(), {points.size(), 3}, self));
}

nb::list faces(const Body& body) {
    nb::list result;
    for (const auto corners : body.polyhedron.outlines()) {
        nb::list outline;
        for (const std::uint32_t vertex : corners)
            outline.append(vertex);
        result.append(nb::tuple(outline));
    }
    return result;
}

nb::object index_array(const std::vector<std::uint32_t>& indices, std::initializer_list<std::size_t> shape) {
    auto* const copy = new std::vector<std::uint32_t>(indices);
    const nb::capsule owner(copy,
                            [](void* memory) noexcept { delete static_cast<std::vector<std::uint32_t>*>(memory); });
    return nb::cast(nb::ndarray<nb::numpy, std::uint32_t>(copy->data(), shape.size(), shape.begin(), owner));
}

nb::object triangles(const Body& body) {
    std::vector<std::uint32_t> corners;
    for (std::size_t face = 0; face < body.polyhedron.face_count(); ++face)
        for (const auto& triangle : body.polyhedron.triangles(face))
            corners.insert(corners.end(), triangle.begin(), triangle.end());
    return index_array(corners, {corners.size() / 3, 3});
}

std::vector<std::uint32_t> sources_of(const Polyhedron& polyhedron) {
    std::vector<std::uint32_t> sources(polyhedron.outlines().size());
    for (std::size_t face = 0; face < sources.size(); ++face)
        sources[face] = polyhedron.source_face(face);
    return sources;
}

nb::object source_faces(const Body& body) {
    const std::vector<std::uint32_t> sources = sources_of(body.polyhedron);
    return index_array(sources, {sources.size()});
}

/// The faces in the form that is read fastest.
nb::object packed_faces(const Body& body) {
    const auto outlines = body.polyhedron.outlines();
    std::vector<std::uint32_t> indices;
    for (const auto outline : outlines) {
        if (outline.size() != outlines[0].size())
            return faces(body);
        indices.insert(indices.end(), outline.begin(), outline.end());
    }
    return index_array(indices, {outlines.size(), outlines[0].size()});
}

/// For pickle: what makes the same body, whose faces have the same ids.
nb::tuple state_of(nb::handle self) {
    const Body& body = nb::cast<const Body&>(self);
    const MeshReport report = body.polyhedron.report();
    const bool is_solid = report.solid_parts + report.inward_parts > 0; // also of a robot's shape
    const Solid solid = is_solid ? Solid::automatic : Solid::no;
    const std::vector<std::uint32_t> sources = sources_of(body.polyhedron);
    std::vector<std::uint32_t> in_order(sources.size());
    std::iota(in_order.begin(), in_order.end(), 0U);
    const bool has_sources = sources != in_order || report.moved_inwards > 0;
    return nb::make_tuple(vertices(self), packed_faces(body), body.threads, name_of(solid), report.radius,
                          has_sources ? index_array(sources, {sources.size()}) : nb::none(), report.moved_inwards);
}

Body body_of_state(const nb::tuple& state) {
    const PolyhedronOptions options{
        .threads = nb::cast<unsigned>(state[2]), .solid = solid_from(state[3]), .radius = nb::cast<double>(state[4])};
    Body body = body_from(state[0], state[1], options);
    if (const nb::object sources = state[5]; !sources.is_none()) {
        const IndexArray ids(sources, "state");
        body.polyhedron = body.polyhedron.with_sources(
            std::vector<std::uint32_t>(ids.numbers().begin(), ids.numbers().end()), nb::cast<double>(state[6]));
    }
    return body;
}

void set_state(Body& body, const nb::tuple& state) {
    constexpr std::size_t parts = 7;
    try {
        if (state.size() == parts) {
            new (&body) Body(body_of_state(state));
            return;
        }
    } catch (const nb::cast_error&) { // another type
    }
    throw InvalidInput("state: is not that of a polyhedron");
}

std::string repr(const Body& body) {
    const MeshReport report = body.polyhedron.report();
    return "<chasles.Polyhedron: " + std::to_string(report.vertices) + " vertices, " + std::to_string(report.faces) +
           " faces, " + (report.closed ? "closed" : "open") + ">";
}

std::string repr_of_report(const MeshReport& report) {
    return "MeshReport(vertices=" + std::to_string(report.vertices) + ", faces=" + std::to_string(report.faces) +
           ", edges=" + std::to_string(report.edges) + ", closed=" + (report.closed ? "True" : "False") + ")";
}

void bind_report(nb::module_& module) {
    nb::class_<MeshReport>(module, "MeshReport", doc("MeshReport"))
        .def_ro("vertices", &MeshReport::vertices, doc("MeshReport.vertices"))
        .def_ro("distinct_vertices", &MeshReport::distinct_vertices, doc("MeshReport.distinct_vertices"))
        .def_ro("faces", &MeshReport::faces, doc("MeshReport.faces"))
        .def_ro("triangles", &MeshReport::triangles, doc("MeshReport.triangles"))
        .def_ro("polygons", &MeshReport::polygons, doc("MeshReport.polygons"))
        .def_ro("edges", &MeshReport::edges, doc("MeshReport.edges"))
        .def_ro("boundary_edges", &MeshReport::boundary_edges, doc("MeshReport.boundary_edges"))
        .def_ro("nonmanifold_edges", &MeshReport::nonmanifold_edges, doc("MeshReport.nonmanifold_edges"))
        .def_ro("dropped_faces", &MeshReport::dropped_faces, doc("MeshReport.dropped_faces"))
        .def_ro("segments", &MeshReport::segments, doc("MeshReport.segments"))
        .def_ro("closed", &MeshReport::closed, doc("MeshReport.closed"))
        .def_ro("unpaired_edges", &MeshReport::unpaired_edges, doc("MeshReport.unpaired_edges"))
        .def_ro("parts", &MeshReport::parts, doc("MeshReport.parts"))
        .def_ro("solid_parts", &MeshReport::solid_parts, doc("MeshReport.solid_parts"))
        .def_ro("inward_parts", &MeshReport::inward_parts, doc("MeshReport.inward_parts"))
        .def_ro("volume", &MeshReport::volume, doc("MeshReport.volume"))
        .def_ro("radius", &MeshReport::radius, doc("MeshReport.radius"))
        .def_ro("moved_inwards", &MeshReport::moved_inwards, doc("MeshReport.moved_inwards"))
        .def("__repr__", repr_of_report);
}

const std::string& constructor_doc() {
    static const std::string text =
        std::string("Makes a body from arrays.\n\n") + doc("Polyhedron.from_polygons") +
        "\n\nParameters\n----------\nvertices : array (n, 3)\n    Points, in the mesh's unit.\n"
        "faces : array (m, k), or a list of m lists\n    Vertex indices from 0.\n"
        "triangulate : bool\n" +
        indented(doc("PolyhedronOptions.triangulate")) + "threads : int\n" +
        indented(doc("PolyhedronOptions.threads")) + "solid : str\n    'automatic', 'yes' or 'no':\n" +
        indented(doc("Solid")) + "radius : float\n" + indented(doc("PolyhedronOptions.radius"));
    return text;
}

} // namespace

void bind_polyhedron(nb::module_& module) {
    bind_report(module);
    nb::class_<Body>(module, "Polyhedron", doc("Polyhedron"))
        .def(
            "__init__",
            [](Body* self, nb::handle points, nb::handle outlines, bool triangulate, unsigned threads, nb::handle solid,
               double radius) {
                new (self) Body(body_from(points, outlines, {triangulate, threads, solid_from(solid), radius}));
            },
            "vertices"_a.none(), "faces"_a.none(), "triangulate"_a = false, "threads"_a = 0,
            "solid"_a.none() = "automatic", "radius"_a = 0.0,
            nb::sig("def __init__(self, vertices: numpy.typing.ArrayLike, "
                    "faces: numpy.typing.ArrayLike | collections.abc.Sequence[collections.abc.Sequence[int]], "
                    "triangulate: bool = False, threads: int = 0, solid: str = 'automatic', radius: float = 0.0) -> "
                    "None"),
            constructor_doc().c_str())
        .def_prop_ro("vertices", vertices, nb::sig("def vertices(self) -> numpy.typing.NDArray[numpy.float64]"),
                     doc("Polyhedron.vertices"))
        .def_prop_ro("faces", faces, nb::sig("def faces(self) -> list[tuple[int, ...]]"),
                     "The outline of each face: its vertex ids in order, at least three. `Polyhedron` makes the body "
                     "again from\n`vertices` and `faces`: after `report.faces` faces of the body come dropped faces "
                     "without area that close gaps of the\nsurface, where a vertex lies on an edge of another face.")
        .def_prop_ro("triangles", triangles, nb::sig("def triangles(self) -> numpy.typing.NDArray[numpy.uint32]"),
                     "Triangles that cover the faces, (t, 3) vertex ids. Inner diagonals are not edges of the body.")
        .def_prop_ro("source_faces", source_faces,
                     nb::sig("def source_faces(self) -> numpy.typing.NDArray[numpy.uint32]"),
                     "For each of `faces`, its id in the input, (f,). A contact names a face by this id. It is another "
                     "one than the\n"
                     "index in `faces` only where faces without area were dropped or polygons were cut.")
        .def_prop_ro(
            "radius", [](const Body& body) { return body.polyhedron.radius(); }, doc("Polyhedron.radius"))
        .def(
            "with_radius",
            [](const Body& body, double radius) {
                return Body{body.polyhedron.with_radius(radius), body.threads};
            },
            "radius"_a, nb::sig("def with_radius(self, radius: float) -> Polyhedron"), doc("Polyhedron.with_radius"))
        .def_prop_ro(
            "report", [](const Body& body) { return body.polyhedron.report(); }, doc("MeshReport"))
        .def("__getstate__", state_of, nb::sig("def __getstate__(self) -> tuple"))
        .def("__setstate__", set_state)
        .def("__repr__", repr);
    module.def("sphere", made<make_sphere, double>, "radius"_a, nb::sig("def sphere(radius: float) -> Polyhedron"),
               doc("make_sphere"));
    module.def("capsule", made<make_capsule, double, double>, "radius"_a, "length"_a,
               nb::sig("def capsule(radius: float, length: float) -> Polyhedron"), doc("make_capsule"));
    module.def(
        "load_points",
        [](const std::filesystem::path& file, double radius) {
            const WithoutGil without_gil;
            return Body{load_points(file, radius)};
        },
        "file"_a, "radius"_a, nb::sig("def load_points(file: str | os.PathLike[str], radius: float) -> Polyhedron"),
        doc("load_points"));
    module.def("points", points, "points"_a.none(), "radius"_a,
               nb::sig("def points(points: numpy.typing.ArrayLike, radius: float) -> Polyhedron"), doc("make_points"));
    module.def("load", load, "file"_a, "triangulate"_a = false, "threads"_a = 0, "solid"_a.none() = "automatic",
               "radius"_a = 0.0,
               nb::sig("def load(file: str | os.PathLike[str], triangulate: bool = False, "
                       "threads: int = 0, solid: str = 'automatic', radius: float = 0.0) -> Polyhedron"),
               doc("Polyhedron.load"));
    module.def("load_parts", load_parts, "file"_a, "triangulate"_a = false, "threads"_a = 0,
               "solid"_a.none() = "automatic", "radius"_a = 0.0,
               nb::sig("def load_parts(file: str | os.PathLike[str], triangulate: bool = False, "
                       "threads: int = 0, solid: str = 'automatic', radius: float = 0.0) -> dict[str, Polyhedron]"),
               doc("load_parts"));
}

} // namespace chasles::python
