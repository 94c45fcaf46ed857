// The pairs of bodies that may touch, in the order in which they may do so.
// Source: docs/derivations/27-scenes.md, "Pairs".
#pragma once

#include "chasles/scene/box_pairs.h"
#include "chasles/scene/scene.h"

namespace chasles::scene {

/// A pair of bodies that may come within the margin.
struct PairTask {
    double earliest = 0; ///< proven not to do so before
    IndexPair pair;      ///< the moving and the fixed body
};

/// Sorted by `earliest`, then by names. Pairs that are not listed are clear or not tested.
std::vector<PairTask> pair_tasks(const Scene& scene, const SceneQuery& query);

/// The same in parts. What each body sweeps; the boxes are wide enough for the margin.
std::vector<SweptBody> swept_bodies(const Scene& scene, const SceneQuery& query);
/// The pairs in no useful order, but in the same one for any number of threads.
std::vector<PairTask> near_pairs(const Scene& scene, const SceneQuery& query, const std::vector<SweptBody>& bodies,
                                 const BoxTree& tree);

using PairNames = std::pair<std::string_view, std::string_view>;
PairNames names_of(const Scene& scene, const IndexPair& pair);

/// The moving and the fixed body of a pair: a body that stands still is the fixed one, else the order of names decides.
IndexPair in_their_roles(const Scene& scene, const IndexPair& pair);

} // namespace chasles::scene
