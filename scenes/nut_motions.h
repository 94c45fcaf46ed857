// Where a nut goes when it is turned on its bolt: poses and paths for the queries.
#pragma once

#include "chasles/motion/pose.h"

#include <vector>

namespace chasles::scenes {

/// A turn about z with a slide along it.
struct NutTurn {
    double height = 0;         ///< of the nut at the start, mm
    double turns = 1;          ///< counter-clockwise seen from the tip, which unscrews
    double slide_per_turn = 2; ///< mm; the pitch for the right screw
};

/// The nut after some of the turns.
Pose nut_pose(const NutTurn& motion, double turns_done);

/// A screw between two poses turns by less than half a turn, so that a path needs some poses in between; a dozen keep
/// many cores busy.
inline constexpr int steps_per_turn = 12;

/// The whole motion as a path of equal steps, steps_per_turn of them if it is one turn. The queries cut each step
/// again by their `max_turn`.
std::vector<Pose> nut_path(const NutTurn& motion);

/// How far the slide of one of the paper's motions strays from a uniform helix, at most, where the whole motion is cut
/// into pieces that turn by `max_turn` radians: |tau(time) - time| times the piece's slide.
double slide_deviation(double slide_per_turn, double max_turn);

} // namespace chasles::scenes
