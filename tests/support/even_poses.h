// Closed forms of the even motions in plain double, written apart from the library.
#pragma once

#include "chasles/motion/pose.h"

#include <cmath>

namespace chasles::test {

/// Constant velocity: slerp, while `centre` goes straight.
inline Eigen::Isometry3d velocity_at(const Pose& start, const Pose& goal, const Eigen::Vector3d& centre, double time) {
    const Eigen::Isometry3d from = start.isometry(), to = goal.isometry();
    const Eigen::Quaterniond turned = Eigen::Quaterniond(from.linear()).slerp(time, Eigen::Quaterniond(to.linear()));
    const Eigen::Vector3d place = (1 - time) * (from * centre) + time * (to * centre);
    return Eigen::Translation3d(place) * turned * Eigen::Translation3d(-centre);
}

/// Constant twist between two poses that differ by a turn: even turn about the axis of their screw, even slide along
/// it.
inline Eigen::Isometry3d twist_at(const Pose& start, const Pose& goal, double time) {
    const Eigen::Isometry3d from = start.isometry(), whole = goal.isometry() * from.inverse();
    const Eigen::AngleAxisd turn(whole.linear());
    const double slide = whole.translation().dot(turn.axis());
    const Eigen::Vector3d across = whole.translation() - slide * turn.axis();
    const Eigen::Vector3d on_axis = (across + turn.axis().cross(across) / std::tan(turn.angle() / 2)) / 2;
    return Eigen::Translation3d(on_axis + time * slide * turn.axis()) *
           Eigen::AngleAxisd(time * turn.angle(), turn.axis()) * Eigen::Translation3d(-on_axis) * from;
}

} // namespace chasles::test
