#include "chasles/query/traversal.h"

#include "chasles/query/face_sieve.h"
#include "chasles/query/found_contacts.h"
#include "chasles/query/near_search.h"
#include "chasles/query/overlaps.h"
#include "chasles/query/piece_numbers.h"
#include "chasles/query/plane_between.h"

namespace chasles::query {

namespace {

/// The leaves of one search for features that touch; `run` is called once.
class TouchSearch {
public:
    explicit TouchSearch(const PieceSearch& search)
        : search_(search), numbers_(search), sieve_(search.moving, search.fixed, numbers_.maps, numbers_.scale, 0),
          filter_(search.moving, search.fixed, {numbers_.scale, {}}), filter_maps_(numbers_.maps),
          contacts_(search, numbers_.scale) {}

    PieceResult run() {
        const std::uint64_t node_pairs = Walk(search_.moving.hierarchy(), search_.fixed.hierarchy(), numbers_.times, 0,
                                              search_.find != Find::any, *this)
                                             .run();
        PieceResult result = contacts_.take();
        work_.node_pairs = node_pairs;
        work_.elementary_tests = filter_.workspace().elementary_tests;
        work_.root_brackets = filter_.workspace().root_brackets;
        result.work += work_;
        return result;
    }

    [[nodiscard]] double best() const { return contacts_.best(); }
    [[nodiscard]] bool is_over() const { return contacts_.is_over(); }
    /// By the plane that was found, if there is one, from `first` on.
    bool is_kept_apart(const NodePair& pair, double first) {
        return plane_ && plane_->range().lower <= first && plane_->keeps_apart(pair.moving, pair.fixed);
    }
    void test(const FacePair& pair) {
        ++work_.face_pairs;
        sieve_.sift(pair, contacts_.best(),
                    [&](const TauRange& part, const CornerSides& moving, const CornerSides& fixed) {
                        test_features(pair, part, moving, fixed);
                    });
        if (contacts_.at_once() >= many_at_once_)
            look_for_plane(pair);
    }

private:
    void test_features(const FacePair& pair, const TauRange& part, const CornerSides& moving_sides,
                       const CornerSides& fixed_sides) {
        const auto& [moving_face, fixed_face, interval, when, first_left] = pair;
        const Polyhedron& moving = search_.moving;
        const Polyhedron& fixed = search_.fixed;
        if (filter_maps_.set(part))
            filter_.use(filter_maps_.maps(), filter_tolerance(search_.tolerance / part.width()));
        if (search_.check_start && part.lower <= 0)
            look_for_overlaps(filter_, moving, moving_face, fixed, fixed_face,
                              [&](const Overlap& overlap) { contacts_.add(overlap); });
        for (const std::uint32_t vertex : moving.owned_vertices(moving_face))
            if (moving_sides.may_meet(vertex))
                if (const auto found = filter_.vertex_face(vertex, fixed_face))
                    add({{ContactKind::vertex_face, {vertex, vertex}, {fixed_face, fixed_face}}, *found}, part);
        for (const std::uint32_t vertex : fixed.owned_vertices(fixed_face))
            if (fixed_sides.may_meet(vertex))
                if (const auto found = filter_.face_vertex(moving_face, vertex))
                    add({{ContactKind::face_vertex, {moving_face, moving_face}, {vertex, vertex}}, *found}, part);
        for (const Edge& moving_edge : moving.owned_edges(moving_face)) {
            if (!moving_sides.may_meet(moving_edge))
                continue;
            const auto path = filter_.path_of(moving_edge);
            for (const Edge& fixed_edge : fixed.owned_edges(fixed_face)) {
                if (!fixed_sides.may_meet(fixed_edge))
                    continue;
                if (const auto found = filter_.edge_edge(path, fixed_edge))
                    add({{ContactKind::edge_edge, {moving_edge.from, moving_edge.to}, {fixed_edge.from, fixed_edge.to}},
                         *found},
                        part);
            }
        }
    }

    void add(Candidate candidate, const TauRange& part) {
        candidate.tau.lower = part.at(candidate.tau.lower);
        candidate.tau.upper = std::min(part.upper, part.at(candidate.tau.upper));
        contacts_.add(candidate);
    }

    /// Faces that touch with many others, all at the same time: what keeps these two apart until shortly before may
    /// keep all of them apart.
    void look_for_plane(const FacePair& pair) {
        many_at_once_ *= 2;
        const auto until = contacts_.early_enough();
        if (!until || *until <= pair.first_left)
            return;
        plane_ = PlaneBetween::faces(
            {search_.moving, search_.fixed, contacts_.maps(), numbers_.scale, {pair.first_left, *until}}, pair.moving,
            pair.fixed);
        if (plane_)
            contacts_.leave_open_after(*until);
    }

    const PieceSearch& search_;
    const PieceNumbers numbers_;
    FaceSieve sieve_;
    FeaturePairs<double> filter_;
    RangeMaps filter_maps_;
    FoundContacts contacts_;
    std::optional<PlaneBetween> plane_;
    std::size_t many_at_once_ = 4; ///< a plane is looked for when so many were found
    Work work_;
};

} // namespace

PieceResult search_piece(const PieceSearch& search) {
    return search.margin > 0 ? search_piece_with_margin(search) : TouchSearch(search).run();
}

} // namespace chasles::query
