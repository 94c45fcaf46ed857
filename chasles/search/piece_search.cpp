#include "chasles/search/piece_search.h"

#include "chasles/culling/face_culler.h"
#include "chasles/culling/separating_plane.h"
#include "chasles/search/found_contacts.h"
#include "chasles/search/near_search.h"
#include "chasles/search/overlaps.h"
#include "chasles/search/piece_context.h"

namespace chasles::search {

namespace {

/// The leaves of one search for features that touch; `run` is called once.
class TouchSearch {
public:
    explicit TouchSearch(const PieceSearch& search)
        : search_(search), numbers_(search), culler_(search.moving, search.fixed, numbers_.maps, numbers_.scale, 0),
          filter_(search.moving, search.fixed, {numbers_.scale, {}}), filter_maps_(numbers_.maps),
          contacts_(search, numbers_.scale) {}

    PieceResult run() {
        const std::uint64_t node_pairs = culling::BvhTraversal(search_.moving.bvh(), search_.fixed.bvh(),
                                                               numbers_.times, 0, search_.find != Find::any, *this)
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
    bool is_kept_apart(const culling::NodePair& pair, double first) {
        return plane_ && plane_->range().lower <= first && plane_->keeps_apart(pair.moving, pair.fixed);
    }
    void test(const culling::FacePair& pair) {
        ++work_.face_pairs;
        culler_.cull(pair, contacts_.best(),
                     [&](const culling::TimeRange& part, const culling::CornerSides& moving,
                         const culling::CornerSides& fixed) { test_features(pair, part, moving, fixed); });
        if (contacts_.at_once() >= many_at_once_)
            look_for_plane(pair);
    }

private:
    void test_features(const culling::FacePair& pair, const culling::TimeRange& part,
                       const culling::CornerSides& moving_sides, const culling::CornerSides& fixed_sides) {
        const auto& [moving_face, fixed_face, interval, when, first_left] = pair;
        const Body& moving = search_.moving;
        const Body& fixed = search_.fixed;
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

    void add(Candidate candidate, const culling::TimeRange& part) {
        candidate.tau.lower = part.at(candidate.tau.lower);
        candidate.tau.upper = std::min(part.upper, part.at(candidate.tau.upper));
        contacts_.add(candidate);
    }

    /// Faces that touch with many others, all at the same time: what keeps these two apart until shortly before may
    /// keep all of them apart.
    void look_for_plane(const culling::FacePair& pair) {
        many_at_once_ *= 2;
        const auto until = contacts_.early_enough();
        if (!until || *until <= pair.first_left)
            return;
        plane_ = culling::SeparatingPlane::faces(
            {search_.moving, search_.fixed, contacts_.maps(), numbers_.scale, {pair.first_left, *until}}, pair.moving,
            pair.fixed);
        if (plane_)
            contacts_.leave_open_after(*until);
    }

    const PieceSearch& search_;
    const PieceContext numbers_;
    culling::FaceCuller culler_;
    FeaturePairs<double> filter_;
    culling::RangeMaps filter_maps_;
    FoundContacts contacts_;
    std::optional<culling::SeparatingPlane> plane_;
    std::size_t many_at_once_ = 4; ///< a plane is looked for when so many were found
    Work work_;
};

} // namespace

PieceResult search_piece(const PieceSearch& search) {
    return search.margin > 0 ? search_piece_with_margin(search) : TouchSearch(search).run();
}

} // namespace chasles::search
