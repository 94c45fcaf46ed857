#include "chasles/motion/motion_ends.h"

#include "chasles/algebra/rounding_mode.h"
#include "chasles/base/invalid_input.h"

namespace chasles {

namespace {

/// The members of a pose are open to everyone: what its constructor refuses is refused here again.
Pose checked(const Pose& pose) {
    return motion::is_ordinary(pose) ? pose : Pose(pose.translation, Eigen::Quaterniond(pose.rotation));
}

void require_rounding_to_nearest() {
    if (!algebra::rounds_to_nearest())
        throw InvalidInput("motion: floating point: must round to nearest; it is set to round otherwise");
}

} // namespace

MotionEnds MotionEnds::between(const Pose& start, const Pose& goal) {
    require_rounding_to_nearest();
    MotionEnds ends; // as one list, all of it would be cleared first, with the room for what there is none of
    ends.given_start.pose = checked(start);
    ends.given_goal.pose = checked(goal);
    return ends;
}

MotionEnds MotionEnds::relative(const Pose& moving_start, const Pose& moving_goal, const Pose& fixed_start,
                                const Pose& fixed_goal) {
    MotionEnds ends = between(moving_start, moving_goal);
    ends.fixed = {checked(fixed_start), checked(fixed_goal)};
    ends.given_start.seen_from = ends.fixed->start;
    ends.given_goal.seen_from = ends.fixed->goal;
    return ends;
}

Pose MotionEnds::fixed_pose_at(double time) const {
    if (!fixed)
        return {};
    return motion::screw_pose(motion::exact(fixed->start), motion::exact(fixed->goal), {time, time});
}

Pose MotionEnds::pose_at_end(double time) const {
    const GivenPose& given = time <= 0 ? given_start : given_goal;
    if (!fixed && !given.seen_from)
        return motion::normalized(given.pose);
    return in_world(motion::rounded(motion::in_fixed_frame<algebra::DoubleDouble>(given)), time);
}

Pose MotionEnds::in_world(const Pose& pose, double time) const {
    if (!fixed)
        return pose;
    return motion::rounded(motion::composed(motion::exact(fixed_pose_at(time)), motion::exact(pose)));
}

MotionFrame::MotionFrame(const MotionEnds& ends)
    : MotionEnds(ends), start(motion::in_fixed_frame<Scalar>(given_start)),
      goal(motion::in_fixed_frame<Scalar>(given_goal)) {}

} // namespace chasles
