// The end poses that a motion is made from, and the world frame that results are reported in.
#pragma once

#include "chasles/motion/pose.h"
#include "chasles/motion/screw_path.h"

namespace chasles::motion {

/// The poses of a fixed body that moves too, in the world.
struct FixedEnds {
    Pose start;
    Pose goal;
};

/// The poses of a fixed body, if it moves. One flag smaller than std::optional: MotionEnds puts its own flags beside
/// it.
class OptionalFixedEnds {
public:
    OptionalFixedEnds& operator=(const FixedEnds& ends) {
        ends_ = ends;
        is_set_ = true;
        return *this;
    }
    explicit operator bool() const { return is_set_; }
    FixedEnds* operator->() { return &ends_; }
    const FixedEnds* operator->() const { return &ends_; }

private:
    FixedEnds ends_;
    bool is_set_ = false;
};

/// The end poses of a motion as they were given. Each pose of the moving body is in the frame of the fixed body, or in
/// the world and then seen from the fixed body at that end.
struct MotionEnds {
    Pose start;
    Pose goal;
    [[no_unique_address]] OptionalFixedEnds fixed; ///< empty if the fixed body's frame is the world
    bool start_is_in_world = false;                ///< both only with `fixed`
    bool goal_is_in_world = false;

    /// For a moving body and a fixed body that stands still at the origin of the world. Throws InvalidInput for a pose
    /// that cannot be used.
    static MotionEnds between(const Pose& start, const Pose& goal);

    /// For two moving bodies; all poses are in the world.
    static MotionEnds relative(const Pose& moving_start, const Pose& moving_goal, const Pose& fixed_start,
                               const Pose& fixed_goal);

    /// The pose of the fixed body from which an end pose is seen; null if the end pose is in its frame already.
    [[nodiscard]] const Pose* start_seen_from() const { return start_is_in_world ? &fixed->start : nullptr; }
    [[nodiscard]] const Pose* goal_seen_from() const { return goal_is_in_world ? &fixed->goal : nullptr; }

    /// The fixed body in the world, along its own screw with uniform turn and slide.
    [[nodiscard]] Pose fixed_pose_at(double time) const;

    /// The same with another goal of the moving body.
    [[nodiscard]] MotionEnds with_goal(const Pose& goal_in_world) const;

    /// Back from the goal to the start.
    [[nodiscard]] MotionEnds reversed() const;

    /// The moving body in the world at time 0 or before, or at time 1 or after.
    [[nodiscard]] Pose pose_at_end(double time) const;

    /// A pose in the fixed body's frame at a time, in the world.
    [[nodiscard]] Pose in_world(const Pose& pose, double time) const;
};

/// The point, which is in the frame of a body. Throws InvalidInput "motion: centre: WHY" if it cannot be used.
const Eigen::Vector3d& checked_centre(const Eigen::Vector3d& centre);

/// An end pose in the fixed body's frame, in a scalar that holds every double.
template <class S>
GeneralPose<S> seen_from(const Pose& pose, const Pose* frame) {
    const GeneralPose<S> result = pose_in<S>(pose);
    return frame ? seen_from(pose_in<S>(*frame), result) : result;
}

/// Both end poses in the fixed body's frame, in double-double.
struct RelativeEnds {
    using Scalar = algebra::DoubleDouble;
    GeneralPose<Scalar> start;
    GeneralPose<Scalar> goal;

    explicit RelativeEnds(const MotionEnds& ends)
        : start(seen_from<Scalar>(ends.start, ends.start_seen_from())),
          goal(seen_from<Scalar>(ends.goal, ends.goal_seen_from())) {}
};

} // namespace chasles::motion
