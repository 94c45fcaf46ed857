// Which two bodies of a scene come nearest? Source: docs/derivations/27-scenes.md, "Nearest".
#pragma once

#include "chasles/query/least_distance.h"
#include "chasles/scene/pairs_by_distance.h"

namespace chasles::scene {

struct NearestPairQuery {
    PairLists pairs;
    LeastDistanceOptions options = {};
};

/// The nearest pair, over the whole time [0, 1], without the numbers of untested ones. Throws InvalidInput for an
/// option out of its range, for an unknown index, and if all pairs are farther apart than Pose::largest_length. At a
/// Limit the bracket is that of what is known so far.
SceneDistance nearest_pair(const Scene& scene, const NearestPairQuery& query);

} // namespace chasles::scene
