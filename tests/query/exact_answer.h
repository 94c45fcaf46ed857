// The exact first contact of two bodies: all pairs of features in exact rationals, without filter, hierarchy, or
// subdivision of time.
#pragma once

#include "chasles/mesh/polyhedron.h"
#include "chasles/search/feature_tests.h"
#include "tests/support/rational.h"

namespace chasles::test {

/// Whether edges pass through faces at the start, and the earliest contact of any pair of features.
struct ExactAnswer {
    bool overlaps = false;
    std::optional<algebra::FeasibleInterval> first;

    void keep(const std::optional<algebra::FeasibleInterval>& found) {
        if (found && (!first || found->lower < first->lower))
            first = found;
    }
};

inline std::vector<Edge> sides_of(std::span<const std::uint32_t> face) {
    std::vector<Edge> sides;
    for (std::size_t i = 0; i < face.size(); ++i) {
        const auto [from, to] = std::minmax(face[i], face[(i + 1) % face.size()]);
        sides.push_back({from, to});
    }
    return sides;
}

inline ExactAnswer exact_answer(const Polyhedron& a, const Polyhedron& b,
                                const motion::RationalMotion<Rational>& motion, double width = 1e-9) {
    using elementary::Ends;
    const auto maps = motion::control_maps(motion);
    search::FeatureTests<Rational> tests(a.body(), b.body(), {});
    tests.use(maps, {width, 1e-32});
    ExactAnswer answer;
    const auto single = [](std::uint32_t id) { return Feature{id, id}; };
    const auto named = [](const Edge& edge) { return Feature{edge.from, edge.to}; };
    const auto passes = [&](bool edge_is_moving, const Edge& edge, std::uint32_t face) {
        return tests.passage({edge_is_moving, named(edge), single(face)}, Ends::proven_opposite).has_value();
    };
    // Every corner and every side of every face, whoever owns them.
    for (std::uint32_t f = 0; f < a.face_count(); ++f) {
        for (std::uint32_t g = 0; g < b.face_count(); ++g) {
            for (const std::uint32_t vertex : a.face(f))
                answer.keep(tests.touch({ContactKind::vertex_face, single(vertex), single(g)}));
            for (const std::uint32_t vertex : b.face(g))
                answer.keep(tests.touch({ContactKind::face_vertex, single(f), single(vertex)}));
            for (const Edge& edge : sides_of(a.face(f))) {
                answer.overlaps = answer.overlaps || passes(true, edge, g);
                for (const Edge& other : sides_of(b.face(g)))
                    answer.keep(tests.touch({ContactKind::edge_edge, named(edge), named(other)}));
            }
            for (const Edge& edge : sides_of(b.face(g)))
                answer.overlaps = answer.overlaps || passes(false, edge, f);
        }
    }
    return answer;
}

} // namespace chasles::test
