// Where a point of the moving body starts and ends, in the fixed body's frame and in double, and balls around its path.
// Source: docs/derivations/07-swept-boxes.md, "Far apart".
#pragma once

#include "chasles/motion/motion_ends.h"

namespace chasles::motion {

namespace detail {

[[gnu::always_inline]] inline Vector3<double> position(const Pose& given, const Pose* seen_from,
                                                       const Vector3<double>& point) {
    const Vector3<double> there = placed(pose_in<double>(given), point);
    if (!seen_from)
        return there;
    const auto frame = pose_in<double>(*seen_from);
    return rotated(frame.rotation.conjugate(), there - frame.translation);
}

} // namespace detail

/// The two ends of a point's path.
struct PathEnds {
    Vector3<double> start;
    Vector3<double> goal;

    PathEnds(const MotionEnds& ends, const Vector3<double>& point)
        : start(detail::position(ends.start, ends.start_seen_from(), point)),
          goal(detail::position(ends.goal, ends.goal_seen_from(), point)) {}

    [[nodiscard]] Vector3<double> chord() const { return goal - start; }
    [[nodiscard]] Vector3<double> middle() const { return scale(start + goal, 0.5); }
};

/// The sizes of the poses that the ends were computed from, for bounds of roundings.
inline double size_of_fixed_ends(const MotionEnds& ends) {
    const auto size = [](const Pose& pose) { return norm1(vector_in<double>(pose.translation)); };
    return ends.fixed ? size(ends.fixed->start) + size(ends.fixed->goal) : 0;
}

} // namespace chasles::motion
