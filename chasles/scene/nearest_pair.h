// Which two bodies of a scene come nearest? Best-first search over pairs of nodes of two trees of boxes.
// Source: docs/derivations/27-scenes.md, "Nearest".
#pragma once

#include "chasles/query/least_distance.h"
#include "chasles/scene/scene.h"

#include <optional>
#include <utility>
#include <vector>

namespace chasles::scene {

/// One body of each list makes a pair. Indices are those of Scene::bodies().
struct NearestPairQuery {
    std::vector<std::size_t> first;
    /// Without it, all pairs of bodies of the first list are tested.
    std::optional<std::vector<std::size_t>> second = {};
    LeastDistanceOptions options = {};
};

struct NearestPair {
    /// The first body moves, the second one is fixed; none if there is no pair that is not ignored.
    std::optional<std::pair<std::size_t, std::size_t>> pair;
    /// Of this pair. The lower end of its distance is proven for all pairs, and all work is counted.
    LeastDistance nearest;
    std::size_t searched = 0; ///< number of pairs whose surfaces were compared
};

/// The nearest pair, over the whole time [0, 1]. Where several are equally near, the answer is one of them. Throws
/// InvalidInput for an option out of its range, for an unknown index, and if all pairs are farther apart than
/// Pose::largest_length; Cancelled at a Limit.
NearestPair nearest_pair(const Scene& scene, const NearestPairQuery& query);

} // namespace chasles::scene
