// Pairs of faces that a helical motion may bring together. All others stay apart during the whole motion, however far
// it turns. Source: docs/derivations/32-orbits.md.
#pragma once

#include "chasles/culling/pair_queue.h"
#include "chasles/memory/orbit_tree.h"
#include "chasles/motion/chord_deviation.h"

#include <optional>
#include <vector>

namespace chasles::memory {

/// A motion in the coordinates of two orbit trees: the moving one turns and rises in proportion, up to a distance.
struct OrbitWay {
    double first_turn = 0; ///< of the moving tree, where the motion starts
    double turn = 0;       ///< of the motion; negative if it turns against the axis
    double pitch = 0;      ///< of both trees
    double rise = 0;       ///< of the moving tree over the fixed one
    double reach = 0;      ///< points within it may meet
    double unevenness = 0; ///< of tau over the turn
};

/// The way of an orbit's motion for trees that were made for another orbit, and for bodies that come within `margin`.
/// The moving body lies within the ball, in its own frame. The reach is greater the less the orbits are alike.
OrbitWay way_along(const motion::Orbit& orbit, const motion::Orbit& of_trees, const motion::Ball& moving,
                   double margin);

/// All pairs of leaves that may come within reach of each other, with the windows of tau in which they may. Empty if
/// more than `most_tests` pairs of nodes would be tested. Adds their number to `tests`.
std::optional<std::vector<culling::NodePair>> orbit_pairs(const OrbitTree& moving, const OrbitTree& fixed,
                                                          const OrbitWay& way, std::size_t most_tests,
                                                          std::uint64_t& tests);

} // namespace chasles::memory
