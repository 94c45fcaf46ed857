// The motion of one body of a scene as poses at times of its own: few where linear interpolation is enough.
#pragma once

#include "view/sampled_poses.h"

namespace chasles::view {

/// Poses at ascending times from 0 to 1; one pose without a time if the body rests.
struct SampledTrack {
    std::vector<double> times;
    std::vector<PoseRow> poses;
};

/// Samples a motion until linear interpolation between neighbours looks like the motion: the corners of the body's box
/// deviate by at most a thousandth of its diagonal plus 1e-5 of the way, and no step turns by more than
/// `largest_turn_of_step`. Probes test this. The steps do not get shorter than 2^-13 of the time between two exact
/// times. `exact_times`, in [0, 1] and in any order, are among the times.
SampledTrack sampled_track(const Motion& motion, const Eigen::AlignedBox3d& box,
                           const std::vector<double>& exact_times);

/// The box around a body in its own frame.
Eigen::AlignedBox3d box_around(const Polyhedron& shape);

} // namespace chasles::view
