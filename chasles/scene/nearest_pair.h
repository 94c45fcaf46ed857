// Which two bodies of a scene come nearest? Best-first search over pairs of nodes of two trees of boxes.
// Source: docs/derivations/27-scenes.md, "Nearest".
#pragma once

#include "chasles/query/least_distance.h"
#include "chasles/scene/scene.h"

#include <optional>
#include <utility>
#include <vector>

namespace chasles::scene {

/// One body of each list makes a pair, and the first one moves. Indices are those of Scene::bodies().
struct NearestPairQuery {
    std::vector<std::size_t> first;
    /// Without it, all pairs of bodies of the first list are tested, in the roles of a scene.
    std::optional<std::vector<std::size_t>> second = {};
    LeastDistanceOptions options = {};
    bool rests = true; ///< two bodies that never move are a pair, too
};

/// The nearest pair, over the whole time [0, 1], without the numbers of untested ones. Throws InvalidInput for an
/// option out of its range, for an unknown index, and if all pairs are farther apart than Pose::largest_length. At a
/// Limit the bracket is that of what is known so far.
SceneDistance nearest_pair(const Scene& scene, const NearestPairQuery& query);

} // namespace chasles::scene
