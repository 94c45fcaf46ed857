#include "chasles/search/near_search.h"

#include "chasles/culling/face_culler.h"
#include "chasles/search/found_near.h"
#include "chasles/search/overlaps.h"

namespace chasles::search {

namespace {

/// The leaves of one search with a margin; `run` is called once.
class NearSearch {
public:
    explicit NearSearch(const PieceSearch& search)
        : search_(search), numbers_(search),
          culler_(search.moving, search.fixed, numbers_.maps, numbers_.scale,
                  search.margin + elementary::parallel_slack * numbers_.scale.length),
          filter_(search, numbers_.scale, numbers_.maps), touching_(search.moving, search.fixed, {numbers_.scale, {}}),
          found_(search, numbers_) {}

    PieceResult run() {
        const std::uint64_t node_pairs =
            culling::BvhTraversal(search_.moving.bvh(), search_.fixed.bvh(), numbers_.times, search_.margin,
                                  search_.find != Find::any, *this)
                .run();
        PieceResult result = found_.take();
        work_.node_pairs = node_pairs;
        work_.elementary_tests = filter_.pairs().workspace().elementary_tests;
        work_.root_brackets = filter_.pairs().workspace().root_brackets;
        result.work += work_;
        return result;
    }

    [[nodiscard]] double best() const { return search_.only_start ? 0 : found_.best(); }
    [[nodiscard]] bool is_over() const { return found_.is_over(); }
    static bool is_kept_apart(const culling::NodePair&, double) { return false; }

    void test(const culling::FacePair& pair) {
        ++work_.face_pairs;
        culler_.cull(pair, best(),
                     [&](const culling::TimeRange& part, const culling::CornerSides& moving,
                         const culling::CornerSides& fixed) { test_features(pair, part, moving, fixed); });
    }

private:
    void test_features(const culling::FacePair& pair, const culling::TimeRange& part,
                       const culling::CornerSides& moving_sides, const culling::CornerSides& fixed_sides) {
        if (part != filter_.part())
            filter_.use(part);
        is_at_start_ = search_.check_start && part.lower <= 0;
        if (is_at_start_) {
            touching_.use(numbers_.maps, {});
            look_for_overlaps(touching_, search_.moving, pair.moving, search_.fixed, pair.fixed,
                              [&](const Overlap& overlap) { found_.add(overlap); });
        }
        using enum ContactKind;
        const auto edges = [](const Body& body, std::uint32_t face, const culling::CornerSides& sides, auto visit) {
            for (const Edge& edge : body.owned_edges(face))
                if (sides.may_meet(edge))
                    visit(Feature{edge.from, edge.to});
        };
        const auto vertices = [](const Body& body, std::uint32_t face, const culling::CornerSides& sides, auto visit) {
            for (const std::uint32_t vertex : body.owned_vertices(face))
                if (sides.may_meet(vertex))
                    visit(Feature{vertex, vertex});
        };
        const Feature moving_face{pair.moving, pair.moving};
        const Feature fixed_face{pair.fixed, pair.fixed};
        vertices(search_.moving, pair.moving, moving_sides, [&](const Feature& vertex) {
            ask({vertex_face, vertex, fixed_face});
            edges(search_.fixed, pair.fixed, fixed_sides, [&](const Feature& edge) {
                ask({vertex_edge, vertex, edge});
            });
            vertices(search_.fixed, pair.fixed, fixed_sides, [&](const Feature& other) {
                ask({vertex_vertex, vertex, other});
            });
        });
        vertices(search_.fixed, pair.fixed, fixed_sides, [&](const Feature& vertex) {
            ask({face_vertex, moving_face, vertex});
        });
        edges(search_.moving, pair.moving, moving_sides, [&](const Feature& edge) {
            vertices(search_.fixed, pair.fixed, fixed_sides, [&](const Feature& vertex) {
                ask({edge_vertex, edge, vertex});
            });
            edges(search_.fixed, pair.fixed, fixed_sides, [&](const Feature& other) { ask({edge_edge, edge, other}); });
        });
    }

    void ask(const contact::FeaturePair& features) {
        FirstCrossing crossing(filter_tolerance(search_.tolerance / filter_.part().width()));
        WithinAtStart at_start;
        filter_.pairs().pair(features, [&](const auto& problem) {
            if (is_at_start_)
                at_start(problem);
            if (!search_.only_start)
                crossing(problem);
        });
        found_.add_at_start(features, at_start.answer());
        if (const auto found = NearStage<double>::in_piece(crossing.first(), filter_.part()))
            found_.add(features, *found);
    }

    const PieceSearch& search_;
    const PieceContext numbers_;
    culling::FaceCuller culler_;
    NearStage<double> filter_;
    FeaturePairs<double> touching_; ///< at the start, for edges through faces
    FoundNear found_;
    bool is_at_start_ = false;
    Work work_;
};

} // namespace

HeldContacts::HeldContacts(std::vector<contact::FeaturePair> pairs) : pairs_(std::move(pairs)) {
    std::ranges::sort(pairs_);
}

bool HeldContacts::has(const contact::FeaturePair& pair) const {
    return std::ranges::binary_search(pairs_, pair);
}

PieceResult search_piece_with_margin(const PieceSearch& search) {
    return NearSearch(search).run();
}

} // namespace chasles::search
