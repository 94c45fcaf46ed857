// The pairs of bodies that may touch, in the order in which they may do so.
// Source: docs/derivations/27-scenes.md, "Pairs".
#pragma once

#include "chasles/scene/scene.h"

namespace chasles::scene {

/// A pair of bodies that may come within the margin.
struct PairTask {
    double earliest = 0; ///< proven not to do so before
    std::uint32_t moving = 0;
    std::uint32_t fixed = 0;
};

/// Sorted by `earliest`, then by names. Pairs that are not listed are clear, or ignored.
std::vector<PairTask> pair_tasks(const Scene& scene, const SceneQuery& query);

} // namespace chasles::scene
