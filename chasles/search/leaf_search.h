// The leaves of a traversal: culls a pair of faces and tests the features that are left.
// Source: docs/derivations/13-face-sides.md and 15-flat-on-flat.md.
#pragma once

#include "chasles/base/limit_of_thread.h"
#include "chasles/culling/bvh_traversal.h"
#include "chasles/culling/face_culler.h"
#include "chasles/culling/separating_plane.h"
#include "chasles/search/nearest_at_start.h"
#include "chasles/search/overlaps.h"
#include "chasles/search/piece_search.h"

namespace chasles::search {

/// The leaf tests of one search, for the stages of "touch" or of "within a distance".
template <class Stages>
class LeafSearch {
public:
    /// Both are kept by reference.
    LeafSearch(PieceContext& context, const SearchOptions& options)
        : context_(context), options_(options), stages_(context, options),
          culler_(context.moving(), context.fixed(), stages_.parts(), stages_.culling_margin()) {}

    [[nodiscard]] const culling::PieceParts& parts() const { return stages_.parts(); }

    // The functions that a traversal requires of its leaves.
    [[nodiscard]] double best() const { return stages_.best(); }
    [[nodiscard]] bool is_over() const { return stages_.is_over(); }
    /// By the plane that was found, if there is one, from `first` on. The traversal asks this once for each pair that
    /// it visits.
    bool is_kept_apart(const culling::NodePair& pair, double first) {
        work_on(1);
        if constexpr (Stages::tests_all_kinds)
            if (++visits_ == visits_of_a_long_search)
                test_nearest_at_start();
        return plane_ && plane_->range().lower <= first && plane_->keeps_apart(pair.moving, pair.fixed);
    }
    /// Tests every pair of features that the two faces own and that may come to each other's planes.
    void test(const culling::FacePair& pair) {
        ++work_.face_pairs;
        work_on(work_of_faces);
        const auto faces = culler_.cull(pair, stages_.best());
        if (!faces)
            return;
        const TwoFaces two{pair.moving, pair.fixed};
        stages_.use(faces->part);
        stages_.test_start(two);
        for_each_owned_pair<Stages::tests_all_kinds>(context_.moving(), context_.fixed(), two, faces->moving,
                                                     faces->fixed,
                                                     [&](const FeaturePair& features) { stages_.test(features); });
        if (const auto until = stages_.early_enough())
            search_plane(pair, *until);
    }

    /// No candidate starts before this tau.
    [[nodiscard]] double first_candidate() const { return stages_.first_candidate(); }
    /// Once, and last.
    PieceResult take() {
        PieceResult result = stages_.take();
        result.work += work_;
        return result;
    }

private:
    /// Of a limit, two faces take as much as so many pairs of nodes.
    static constexpr int work_of_faces = 32;
    void work_on(int work) {
        if (watch_.is_over(work))
            throw Stopped{options_.from};
    }

    /// A search visits pairs that may be near at the start in no order of distance.
    static constexpr std::uint64_t visits_of_a_long_search = 1 << 13;

    /// Bodies that start within the margin have a contact at the start, which ends the search. A search that has not
    /// found one among many pairs looks for it where the bodies are nearest.
    void test_nearest_at_start() {
        if (!options_.check_start || stages_.is_over())
            return;
        stages_.use(culling::part_around({}, {0, 0}));
        for (const FeaturePair& features : nearest_at_start(context_, options_.margin, work_))
            stages_.test(features);
    }

    /// Many faces touch at the same time: a plane that separates these two until just before may separate all of them.
    void search_plane(const culling::FacePair& pair, double until) {
        if (until <= pair.first_left)
            return;
        plane_ = culling::SeparatingPlane::faces({context_.moving(),
                                                  context_.fixed(),
                                                  context_.refined_maps(),
                                                  stages_.parts().scale(),
                                                  {pair.first_left, until}},
                                                 pair.moving, pair.fixed);
        if (plane_)
            stages_.stop_search_at(until);
    }

    PieceContext& context_;
    const SearchOptions& options_;
    Stages stages_;
    culling::FaceCuller culler_;
    std::optional<culling::SeparatingPlane> plane_;
    Work work_;
    Watch watch_;
    std::uint64_t visits_ = 0; ///< of pairs of nodes, with a margin
};

} // namespace chasles::search
