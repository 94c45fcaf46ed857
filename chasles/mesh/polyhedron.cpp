// The public handle of a body. make_body.cpp makes the body.
// `Polyhedron::load` is in chasles/io/mesh_files.cpp.
#include "chasles/mesh/polyhedron.h"

#include "chasles/mesh/make_body.h"

namespace chasles {

Polyhedron Polyhedron::from_polygons(std::span<const Eigen::Vector3d> vertices,
                                     std::span<const std::vector<std::uint32_t>> faces,
                                     const PolyhedronOptions& options) {
    const std::vector<std::span<const std::uint32_t>> outlines(faces.begin(), faces.end());
    return from_outlines(vertices, outlines, options);
}

Polyhedron Polyhedron::from_outlines(std::span<const Eigen::Vector3d> vertices,
                                     std::span<const std::span<const std::uint32_t>> outlines,
                                     const PolyhedronOptions& options) {
    return Polyhedron(std::make_shared<const Body>(make_body(vertices, outlines, options)));
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

std::uint32_t Polyhedron::source_face(std::size_t face) const {
    return body_->source_face(face);
}

MeshReport Polyhedron::report() const {
    return body_->report();
}

std::size_t Polyhedron::memory() const {
    return body_->memory();
}

} // namespace chasles
