#include "chasles/motion/motion_ends.h"

#include "chasles/algebra/rounding_mode.h"
#include "chasles/base/invalid_input.h"

namespace chasles::motion {

namespace {

/// The members of a pose are public: poses that its constructor would refuse are refused here.
Pose checked(const Pose& pose) {
    return is_ordinary(pose) ? pose : Pose(pose.translation, Eigen::Quaterniond(pose.rotation));
}

void require_rounding_to_nearest() {
    if (!algebra::rounds_to_nearest())
        throw InvalidInput("motion: floating point: must round to nearest; it is set to round otherwise");
}

} // namespace

MotionEnds MotionEnds::between(const Pose& start, const Pose& goal) {
    require_rounding_to_nearest();
    MotionEnds ends; // member by member: an initializer list would clear the room for `fixed` first
    ends.start = checked(start);
    ends.goal = checked(goal);
    return ends;
}

MotionEnds MotionEnds::relative(const Pose& moving_start, const Pose& moving_goal, const Pose& fixed_start,
                                const Pose& fixed_goal) {
    MotionEnds ends = between(moving_start, moving_goal);
    ends.fixed = {checked(fixed_start), checked(fixed_goal)};
    ends.start_is_in_world = ends.goal_is_in_world = true;
    return ends;
}

const Eigen::Vector3d& checked_centre(const Eigen::Vector3d& centre) {
    if (!centre.allFinite())
        throw InvalidInput("motion: centre: a number is NaN or infinite");
    if (centre.cwiseAbs().maxCoeff() > Pose::largest_length)
        throw InvalidInput("motion: centre: a number is larger than 1e30");
    return centre;
}

Pose MotionEnds::fixed_pose_at(double time) const {
    if (!fixed)
        return {};
    return screw_pose(exact(fixed->start), exact(fixed->goal), {time, time});
}

MotionEnds MotionEnds::with_goal(const Pose& goal_in_world) const {
    MotionEnds ends = *this;
    ends.goal = checked(goal_in_world);
    ends.goal_is_in_world = bool(ends.fixed);
    return ends;
}

MotionEnds MotionEnds::reversed() const {
    MotionEnds back = *this;
    std::swap(back.start, back.goal);
    std::swap(back.start_is_in_world, back.goal_is_in_world);
    if (fixed)
        back.fixed = FixedEnds{fixed->goal, fixed->start};
    return back;
}

Pose MotionEnds::pose_at_end(double time) const {
    const Pose& pose = time <= 0 ? start : goal;
    if (!fixed)
        return normalized(pose);
    const Pose* frame = time <= 0 ? start_seen_from() : goal_seen_from();
    return in_world(rounded(seen_from<algebra::DoubleDouble>(pose, frame)), time);
}

Pose MotionEnds::in_world(const Pose& pose, double time) const {
    if (!fixed)
        return pose;
    return rounded(composed(exact(fixed_pose_at(time)), exact(pose)));
}

} // namespace chasles::motion
