#include "chasles/certificate/certified_body.h"

#include "chasles/base/invalid_input.h"
#include "chasles/base/sha256.h"
#include "chasles/mesh/body.h"

#include <algorithm>
#include <array>
#include <bit>
#include <numeric>
#include <set>

namespace chasles::certificate {

namespace {

/// Whether each edge is one of two faces, in opposite directions, and no face has a corner twice.
bool is_closed(const Polyhedron& body) {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> edges, back;
    for (std::size_t face = 0; face < body.face_count(); ++face) {
        const auto outline = body.face(face);
        std::vector<std::uint32_t> sorted(outline.begin(), outline.end());
        std::ranges::sort(sorted);
        if (std::ranges::adjacent_find(sorted) != sorted.end())
            return false;
        for (std::size_t i = 0; i < outline.size(); ++i) {
            const std::uint32_t from = outline[i], to = outline[(i + 1) % outline.size()];
            edges.emplace_back(from, to);
            back.emplace_back(to, from);
        }
    }
    std::ranges::sort(edges);
    std::ranges::sort(back);
    return edges == back && std::ranges::adjacent_find(edges) == edges.end();
}

template <class Number>
void add(Sha256& hash, Number number) {
    auto bytes = std::bit_cast<std::array<unsigned char, sizeof(Number)>>(number);
    if constexpr (std::endian::native == std::endian::big)
        std::ranges::reverse(bytes);
    hash.add(bytes);
}

} // namespace

std::string hash_of(const Polyhedron& body) {
    Sha256 hash;
    for (std::size_t face = 0; face < body.face_count(); ++face) {
        const auto outline = body.face(face);
        add(hash, std::uint32_t(outline.size()));
        for (const std::uint32_t vertex : outline)
            for (const double coordinate : body.vertices()[vertex])
                add(hash, coordinate + 0.0); // -0 becomes 0
    }
    return hash.digest();
}

void check_body(const Polyhedron& body, const std::string& name) {
    const auto refuse = [&](const std::string& why) { throw InvalidInput("certificate: " + name + ": " + why); };
    const MeshReport report = body.report();
    if (report.moved_inwards > 0)
        refuse("its faces were moved inwards by a radius below 0, so it is not the body of a file");
    for (std::size_t face = 0; face < body.face_count(); ++face)
        if (body.source_face(face) != face)
            refuse("face " + std::to_string(body.source_face(face)) +
                   " was cut, or stands behind one without area that was left out; only meshes whose faces are all "
                   "kept are certified");
    const bool is_round = report.segments == body.face_count(); // a point or a segment with a radius
    if (report.dropped_faces > 0 || (report.segments > 0 && !is_round))
        refuse("it has faces without area, which are not certified");
    if (body.body().volume().is_solid() && !is_closed(body))
        refuse("some of its surface is closed, but not every edge is one of exactly two faces; with the option solid = "
               "no, "
               "its surface can be certified");
}

CertifiedBody::CertifiedBody(const Polyhedron& body) : shape(body), tree(shape), hash(hash_of(body)) {}

void CertifiedBodies::add(const Polyhedron& body) {
    const auto same =
        std::ranges::find_if(bodies_, [&](const auto& known) { return &known->shape.body() == &body.body(); });
    bodies_.push_back(same == bodies_.end() ? std::make_shared<const CertifiedBody>(body) : *same);
}

std::vector<Polyhedron> CertifiedBodies::different() const {
    std::vector<Polyhedron> shapes;
    std::set<std::string> hashes;
    for (const auto& known : bodies_)
        if (hashes.insert(known->hash).second)
            shapes.push_back(known->shape);
    return shapes;
}

std::vector<std::pair<std::size_t, std::size_t>> corners_of_parts(const Polyhedron& body) {
    std::vector<std::uint32_t> above(body.vertex_count());
    std::iota(above.begin(), above.end(), 0U);
    const auto root = [&](std::uint32_t vertex) {
        while (above[vertex] != vertex)
            vertex = above[vertex] = above[above[vertex]];
        return vertex;
    };
    for (std::size_t face = 0; face < body.face_count(); ++face)
        for (const std::uint32_t vertex : body.face(face))
            above[root(vertex)] = root(body.face(face)[0]);
    std::vector<std::pair<std::size_t, std::size_t>> corners;
    std::vector<bool> is_known(body.vertex_count());
    for (std::size_t face = 0; face < body.face_count(); ++face)
        if (const std::uint32_t part = root(body.face(face)[0]); !is_known[part]) {
            is_known[part] = true;
            corners.emplace_back(face, 0);
        }
    return corners;
}

} // namespace chasles::certificate
