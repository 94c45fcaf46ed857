// The motions of bodies as poses at times of their own: few where linear interpolation is enough.
#pragma once

#include "view/sampled_poses.h"

#include <functional>

namespace chasles::view {

/// Poses at ascending times; one pose without a time if the body rests.
struct SampledTrack {
    std::vector<double> times;
    std::vector<PoseRow> poses;
};

/// Bodies whose poses are computed together, such as the links of a robot.
struct PosedBodies {
    std::function<std::vector<Pose>(double time)> poses_at;
    std::vector<Eigen::AlignedBox3d> boxes; ///< around the bodies, in their own frames
    std::vector<double> cuts = {};          ///< ascending times at which velocities may jump
    bool are_smooth_between_stops = false;  ///< then three probes test a step, and otherwise eleven
};

/// Samples motions until linear interpolation between neighbours looks like each of them: the corners of the body's box
/// deviate by at most a thousandth of its diagonal plus 1e-5 of the way, and no step turns by more than
/// `largest_turn_of_step`. Probes test this, among them all cuts and the middles between them. The steps do not get
/// shorter than 2^-13 of the time between two stops or cuts. The stops ascend; the first and the last one are the ends.
/// Stops between equal poses are left out.
/// `progress` gets the number of intervals between stops that are done.
std::vector<SampledTrack> sampled_tracks(const PosedBodies& bodies, const std::vector<double>& stops,
                                         const std::function<void(std::size_t)>& progress = {});

/// The track of one motion from 0 to 1. `exact_times`, in [0, 1] and in any order, are stops.
SampledTrack sampled_track(const Motion& motion, const Eigen::AlignedBox3d& box,
                           const std::vector<double>& exact_times);

/// The times in (0, 1) at which velocities of the motion may jump, ascending: stamps, knots, and ends of pieces.
std::vector<double> cuts_of(const Motion& motion);

/// The box around a body in its own frame.
Eigen::AlignedBox3d box_around(const Polyhedron& shape);

} // namespace chasles::view
