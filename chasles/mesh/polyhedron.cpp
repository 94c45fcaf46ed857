// The public handle of a body. make_body.cpp makes the body.
// `Polyhedron::load` is in chasles/io/mesh_files.cpp.
#include "chasles/mesh/polyhedron.h"

#include "chasles/base/invalid_input.h"
#include "chasles/base/number_text.h"
#include "chasles/mesh/make_body.h"
#include "chasles/mesh/moved_inwards.h"

#include <algorithm>
#include <cmath>

namespace chasles {

namespace {

void check_radius(double radius) {
    constexpr double largest = 1e30;
    if (!(std::abs(radius) <= largest))
        throw InvalidInput("mesh: radius: " + number_text(radius) + " must be in [-1e30, 1e30]");
}

using Outlines = std::vector<std::span<const std::uint32_t>>;

Outlines outlines_of(const Body& body) {
    Outlines outlines;
    for (std::size_t face = 0; face < body.face_count(); ++face)
        outlines.push_back(body.face(face));
    return outlines;
}

/// With faces named as those of the body are.
BodyParts made_again(const Body& body, std::span<const Eigen::Vector3d> vertices, const PolyhedronOptions& options) {
    BodyParts parts = make_body(vertices, outlines_of(body), options);
    std::vector<std::uint32_t> source;
    for (std::size_t face = 0; face < parts.outlines.size(); ++face)
        source.push_back(body.source_face(parts.source.empty() ? face : parts.source[face]));
    parts.source = std::move(source);
    return parts;
}

/// Polygons whose corners do not move alike are no longer planar, and are cut into triangles.
BodyParts moved(const Body& body, PolyhedronOptions options) {
    const double distance = -options.radius;
    options.radius = 0;
    options.triangulate = true;
    BodyParts parts = made_again(body, moved_inwards(body, distance), options);
    if (parts.report.unpaired_edges > 0)
        throw InvalidInput("mesh: radius: " + number_text(-distance) + " opens the surface along " +
                           std::to_string(parts.report.unpaired_edges) +
                           " edges, where faces without area join vertices to edges; mend the mesh, so that faces "
                           "meet in whole edges, or leave its radius at 0");
    parts.report.moved_inwards = distance;
    return parts;
}

} // namespace

Polyhedron Polyhedron::from_polygons(std::span<const Eigen::Vector3d> vertices,
                                     std::span<const std::vector<std::uint32_t>> faces,
                                     const PolyhedronOptions& options) {
    const std::vector<std::span<const std::uint32_t>> outlines(faces.begin(), faces.end());
    return from_outlines(vertices, outlines, options);
}

Polyhedron Polyhedron::from_outlines(std::span<const Eigen::Vector3d> vertices,
                                     std::span<const std::span<const std::uint32_t>> outlines,
                                     const PolyhedronOptions& options) {
    check_radius(options.radius);
    PolyhedronOptions given = options;
    given.radius = std::max(options.radius, 0.0);
    auto body = std::make_shared<const Body>(make_body(vertices, outlines, given));
    return Polyhedron(options.radius < 0 ? std::make_shared<const Body>(moved(*body, options)) : std::move(body));
}

Polyhedron Polyhedron::with_radius(double radius) const {
    check_radius(radius);
    const Solid solid = body_->volume().is_solid() ? Solid::automatic : Solid::no;
    return Polyhedron(std::make_shared<const Body>(radius < 0 ? moved(*body_, {.solid = solid, .radius = radius})
                                                              : chasles::with_radius(body_->parts(), radius)));
}

Polyhedron Polyhedron::with_sources(std::span<const std::uint32_t> source_faces, double moved_inwards) const {
    BodyParts parts = body_->parts();
    const std::size_t faces = parts.outlines.size(), closing = parts.closing.source.size();
    if (source_faces.size() != faces + closing)
        throw InvalidInput("mesh: " + std::to_string(source_faces.size()) + " ids of faces for " +
                           std::to_string(faces + closing) + " outlines");
    parts.source.assign(source_faces.begin(), source_faces.begin() + std::ptrdiff_t(faces));
    parts.closing.source.assign(source_faces.begin() + std::ptrdiff_t(faces), source_faces.end());
    parts.report.moved_inwards = moved_inwards;
    return Polyhedron(std::make_shared<const Body>(std::move(parts)));
}

Polyhedron::Polyhedron(std::shared_ptr<const Body> body) : body_(std::move(body)) {}

std::size_t Polyhedron::vertex_count() const {
    return body_->vertices().size();
}

std::size_t Polyhedron::face_count() const {
    return body_->face_count();
}

std::span<const Eigen::Vector3d> Polyhedron::vertices() const {
    return body_->vertices();
}

std::span<const std::uint32_t> Polyhedron::face(std::size_t face) const {
    return body_->face(face);
}

std::span<const std::uint32_t> Polyhedron::face_triangles(std::size_t face) const {
    return body_->face_triangles(face);
}

std::vector<std::array<std::uint32_t, 3>> Polyhedron::triangles(std::size_t face) const {
    const auto outline = body_->face(face);
    const auto corners = body_->face_triangles(face);
    std::vector<std::array<std::uint32_t, 3>> triangles;
    for (std::size_t i = 0; i + 2 < corners.size(); i += 3)
        triangles.push_back({outline[corners[i]], outline[corners[i + 1]], outline[corners[i + 2]]});
    for (std::size_t i = 2; i < outline.size() && corners.empty(); ++i)
        triangles.push_back({outline[0], outline[i - 1], outline[i]});
    return triangles;
}

std::vector<std::span<const std::uint32_t>> Polyhedron::outlines() const {
    Outlines outlines = outlines_of(*body_);
    const FlatLists<std::uint32_t>& closing = body_->closing().outlines;
    for (std::size_t face = 0; face < closing.size(); ++face)
        outlines.push_back(closing[face]);
    return outlines;
}

std::uint32_t Polyhedron::source_face(std::size_t face) const {
    return face < face_count() ? body_->source_face(face) : body_->closing().source[face - face_count()];
}

double Polyhedron::radius() const {
    return body_->radius();
}

MeshReport Polyhedron::report() const {
    return body_->report();
}

std::size_t Polyhedron::memory() const {
    return body_->memory();
}

} // namespace chasles
