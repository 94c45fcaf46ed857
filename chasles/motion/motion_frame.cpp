#include "chasles/motion/motion_frame.h"

#include "chasles/algebra/rounding_mode.h"
#include "chasles/invalid_input.h"
#include "chasles/motion/screw_pose.h"

namespace chasles {

namespace {

/// The members of a pose are open to everyone: what its constructor refuses is refused here again.
Pose checked(const Pose& pose) {
    if (!algebra::rounds_to_nearest())
        throw InvalidInput("motion: floating point: must round to nearest; it is set to round otherwise");
    return {pose.translation, Eigen::Quaterniond(pose.rotation)};
}

} // namespace

MotionFrame MotionFrame::between(const Pose& start, const Pose& goal) {
    MotionFrame frame;
    frame.start = motion::exact(checked(start));
    frame.goal = motion::exact(checked(goal));
    frame.given_start = {start, {}};
    frame.given_goal = {goal, {}};
    return frame;
}

MotionFrame MotionFrame::relative(const Pose& moving_start, const Pose& moving_goal, const Pose& fixed_start,
                                  const Pose& fixed_goal) {
    MotionFrame frame;
    frame.fixed_start = checked(fixed_start);
    frame.fixed_goal = checked(fixed_goal);
    frame.start = motion::seen_from(motion::exact(frame.fixed_start), motion::exact(checked(moving_start)));
    frame.goal = motion::seen_from(motion::exact(frame.fixed_goal), motion::exact(checked(moving_goal)));
    frame.fixed_moves = true;
    frame.given_start = {moving_start, fixed_start};
    frame.given_goal = {moving_goal, fixed_goal};
    return frame;
}

Pose MotionFrame::fixed_pose_at(double time) const {
    if (!fixed_moves)
        return {};
    return motion::screw_pose(motion::exact(fixed_start), motion::exact(fixed_goal), {time, time});
}

Pose MotionFrame::in_world(const Pose& pose, double time) const {
    if (!fixed_moves)
        return pose;
    return motion::rounded(motion::composed(motion::exact(fixed_pose_at(time)), motion::exact(pose)));
}

} // namespace chasles
