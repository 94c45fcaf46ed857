#include "chasles/motion/motion_frame.h"

#include "chasles/motion/screw_pose.h"

namespace chasles {

MotionFrame MotionFrame::between(const Pose& start, const Pose& goal) {
    MotionFrame frame;
    frame.start = motion::exact(start);
    frame.goal = motion::exact(goal);
    frame.given_start = {start, {}};
    frame.given_goal = {goal, {}};
    return frame;
}

MotionFrame MotionFrame::relative(const Pose& moving_start, const Pose& moving_goal, const Pose& fixed_start,
                                  const Pose& fixed_goal) {
    MotionFrame frame;
    frame.start = motion::seen_from(motion::exact(fixed_start), motion::exact(moving_start));
    frame.goal = motion::seen_from(motion::exact(fixed_goal), motion::exact(moving_goal));
    frame.fixed_start = fixed_start;
    frame.fixed_goal = fixed_goal;
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
