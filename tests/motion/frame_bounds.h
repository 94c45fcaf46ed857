// The bounds of a frame, attacked by the test kit for trajectories of the user's own.
#pragma once

#include "chasles/motion/frames.h"
#include "chasles/motion/own_trajectory.h"

#include <gtest/gtest.h>
#include <vector>

namespace chasles::test {

/// A frame as a trajectory of the user's own.
inline OwnTrajectory as_own(const motion::SharedFrame& frame) {
    OwnTrajectory own;
    own.pose_at = [frame](double time) {
        const auto [place, turn] = frame->at(time);
        return Pose({place.x, place.y, place.z}, Eigen::Quaterniond(turn.w, turn.v.x, turn.v.y, turn.v.z));
    };
    own.bounds = [frame](double from, double to) {
        const motion::RateBounds rates = frame->rates({from, to});
        return MotionBounds{rates.turn_rate, rates.turn_acceleration, rates.speed, rates.acceleration};
    };
    const auto reference = frame->reference();
    own.reference = {double(reference.x), double(reference.y), double(reference.z)};
    frame->add_cuts(own.knots);
    std::erase_if(own.knots, [](double knot) { return knot <= 0 || knot >= 1; });
    return own;
}

inline void expect_bounds_hold(const motion::SharedFrame& frame, std::uint64_t seed) {
    ASSERT_TRUE(frame);
    const auto broken = find_broken_bound(as_own(frame), 300, seed);
    EXPECT_FALSE(broken) << broken->bound << " from " << broken->from << " to " << broken->to << ": stated "
                         << broken->stated << ", found " << broken->found;
}

} // namespace chasles::test
