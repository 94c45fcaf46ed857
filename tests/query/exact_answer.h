// The exact first contact of two bodies: all pairs of features in exact rationals, without filter, hierarchy, or
// subdivision of time.
#pragma once

#include "chasles/search/feature_pairs.h"
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

inline ExactAnswer exact_answer(const Polyhedron& a, const Polyhedron& b,
                                const motion::RationalMotion<Rational>& motion, double width = 1e-9) {
    using elementary::Ends;
    const auto maps = motion::control_maps(motion);
    search::FeaturePairs<Rational> pairs(a.body(), b.body(), {});
    pairs.use(maps, {width, 1e-32});
    ExactAnswer answer;
    for (std::uint32_t f = 0; f < a.face_count(); ++f) {
        for (std::uint32_t g = 0; g < b.face_count(); ++g) {
            for (const std::uint32_t vertex : a.body().owned_vertices(f))
                answer.keep(pairs.vertex_face(vertex, g));
            for (const std::uint32_t vertex : b.body().owned_vertices(g))
                answer.keep(pairs.face_vertex(f, vertex));
            for (const Edge& edge : a.body().owned_edges(f)) {
                answer.overlaps = answer.overlaps || pairs.moving_edge_passage(edge, g, Ends::proven_opposite);
                const auto path = pairs.path_of(edge);
                for (const Edge& other : b.body().owned_edges(g))
                    answer.keep(pairs.edge_edge(path, other));
            }
            for (const Edge& edge : b.body().owned_edges(g))
                answer.overlaps = answer.overlaps || pairs.fixed_edge_passage(edge, f, Ends::proven_opposite);
        }
    }
    return answer;
}

} // namespace chasles::test
