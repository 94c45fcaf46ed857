// The pairs of features that two faces own. A traversal of face pairs visits each pair of features once.
#pragma once

#include "chasles/contact/feature_pair.h"
#include "chasles/mesh/body.h"

namespace chasles::search {

/// Two faces, one of each body.
struct TwoFaces {
    std::uint32_t moving;
    std::uint32_t fixed;
};

/// The pairs of features that two faces own, without those that a filter of vertices and edges excludes.
///
/// `Sides` answers `may_meet(vertex)` and `may_meet(edge)` for the features of one face. With `all_kinds` also edges
/// near vertices and vertices near vertices.
template <bool all_kinds, class Sides, class Visit>
class OwnedPairs {
public:
    /// Keeps the references.
    OwnedPairs(const Body& fixed, const TwoFaces& faces, const Sides& fixed_sides, Visit visit)
        : fixed_(fixed), faces_(faces), fixed_sides_(fixed_sides), visit_(visit) {}

    void visit_all(const Body& moving, const Sides& moving_sides) {
        using enum ContactKind;
        for (const std::uint32_t vertex : moving.owned_vertices(faces_.moving)) {
            if (!moving_sides.may_meet(vertex))
                continue;
            visit_({vertex_face, {vertex, vertex}, {faces_.fixed, faces_.fixed}});
            if constexpr (all_kinds) {
                visit_edges({vertex_edge, {vertex, vertex}, {}});
                visit_vertices({vertex_vertex, {vertex, vertex}, {}});
            }
        }
        visit_vertices({face_vertex, {faces_.moving, faces_.moving}, {}});
        for (const Edge& edge : moving.owned_edges(faces_.moving)) {
            if (!moving_sides.may_meet(edge) || is_left_to_its_vertex(edge))
                continue;
            if constexpr (all_kinds)
                visit_vertices({edge_vertex, {edge.from, edge.to}, {}});
            visit_edges({edge_edge, {edge.from, edge.to}, {}});
        }
    }

private:
    /// A face that is a point has an edge without length. Its vertex takes part in all kinds of pairs by itself.
    static bool is_left_to_its_vertex(const Edge& edge) { return all_kinds && edge.from == edge.to; }

    /// The moving feature of `features` and each vertex of the fixed face, or each edge.
    void visit_vertices(contact::FeaturePair features) {
        for (const std::uint32_t vertex : fixed_.owned_vertices(faces_.fixed))
            if (fixed_sides_.may_meet(vertex)) {
                features.fixed = {vertex, vertex};
                visit_(features);
            }
    }
    void visit_edges(contact::FeaturePair features) {
        for (const Edge& edge : fixed_.owned_edges(faces_.fixed))
            if (fixed_sides_.may_meet(edge) && !is_left_to_its_vertex(edge)) {
                features.fixed = {edge.from, edge.to};
                visit_(features);
            }
    }

    const Body& fixed_;
    TwoFaces faces_;
    const Sides& fixed_sides_;
    Visit visit_;
};

/// A filter that excludes no feature.
struct AllFeatures {
    [[nodiscard]] static bool may_meet(std::uint32_t /*vertex*/) { return true; }
    [[nodiscard]] static bool may_meet(const Edge& /*edge*/) { return true; }
};

/// Calls `visit(feature pair)` for each pair of features that two faces own and that may meet. Inlined, because a query
/// takes two hundredths longer otherwise.
template <bool all_kinds, class Sides, class Visit>
[[gnu::always_inline]] inline void for_each_owned_pair(const Body& moving, const Body& fixed, const TwoFaces& faces,
                                                       const Sides& moving_sides, const Sides& fixed_sides,
                                                       Visit visit) {
    OwnedPairs<all_kinds, Sides, Visit>(fixed, faces, fixed_sides, visit).visit_all(moving, moving_sides);
}

} // namespace chasles::search
