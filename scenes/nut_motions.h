// Poses and paths of a nut that turns on its bolt.
#pragma once

#include "chasles/motion/pose.h"

#include <vector>

namespace chasles::scenes {

/// A turn about the z axis with a slide along it.
struct NutTurn {
    double height = 0;         ///< height of the nut at the start, mm
    double turns = 1;          ///< counter-clockwise when viewed from the tip; this direction unscrews
    double slide_per_turn = 2; ///< mm; the pitch for the right screw
};

/// The pose of the nut after `turns_done` turns.
Pose nut_pose(const NutTurn& motion, double turns_done);

/// A screw between two poses turns by less than half a turn, so a full turn needs several steps. Twelve steps keep many
/// cores busy.
inline constexpr int steps_per_turn = 12;

/// The whole motion as a path of equal steps, steps_per_turn per turn. The queries cut each step further by their
/// `max_turn`.
std::vector<Pose> nut_path(const NutTurn& motion);

/// The largest distance between the slide of the paper's rational motion and the slide of a uniform helix, for a motion
/// that is cut into pieces of `max_turn` radians: the maximum of |tau(time) - time| times the piece's slide.
double slide_deviation(double slide_per_turn, double max_turn);

} // namespace chasles::scenes
