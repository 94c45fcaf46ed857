// The points of two bodies that are nearest to each other during a motion, all of them: what the gradient of the least
// distance is made of. Source: docs/derivations/41-gradients.md.
#pragma once

#include "chasles/query/pair_query.h"

#include <vector>

namespace chasles::query {

/// Two points of the polyhedra that are nearest to each other at some time: a local minimum of their distance.
struct Witness {
    double time = 0; ///< of the motion, in [0, 1]
    double distance = 0;
    Eigen::Vector3d on_moving = Eigen::Vector3d::Zero(); ///< in the frame of the moving body
    Eigen::Vector3d on_fixed = Eigen::Vector3d::Zero();  ///< in the frame of the fixed body
    Eigen::Vector3d normal = Eigen::Vector3d::Zero();    ///< unit, from the fixed body to the moving one, in the world
};

struct Witnesses {
    std::vector<Witness> all; ///< the nearest one first
    /// Whether no other points are as near, as far as can be told: nothing else comes within `level`.
    bool are_all = false;
    double level = 0; ///< a distance of the polyhedra, just above the least one
};

/// A motion of two bodies that stay apart, by reference.
struct WitnessQuery {
    const Body& moving;
    const Body& fixed;
    const motion::AnyTrajectory& trajectory;
};

/// The witnesses of the least distance. `time` is when the bodies are about as near as that. At the limit of the thread
/// `are_all` is false.
Witnesses witnesses_of(const WitnessQuery& query, double time);

} // namespace chasles::query
