// What a motion is made of once two poses are given: exact end poses, and the frame results are reported in.
#pragma once

#include "chasles/motion/pose.h"
#include "chasles/motion/screw_path.h"

#include <optional>

namespace chasles {

/// An end pose of the moving body as it was given: in the frame of the fixed body, or in the world that `seen_from`
/// stands in.
struct GivenPose {
    Pose pose;
    std::optional<Pose> seen_from;
};

namespace motion {

/// In another scalar, which must hold every double.
template <class S>
GeneralPose<S> in_fixed_frame(const GivenPose& given) {
    const GeneralPose<S> pose = pose_in<S>(given.pose);
    return given.seen_from ? seen_from(pose_in<S>(*given.seen_from), pose) : pose;
}

} // namespace motion

/// Where a fixed body that moves too starts and ends in the world.
struct FixedEnds {
    Pose start;
    Pose goal;
};

/// A motion as it was given: end poses of the moving body, and the fixed body's own in the world.
struct MotionEnds {
    GivenPose given_start;
    GivenPose given_goal;
    std::optional<FixedEnds> fixed;              ///< if there are none, the fixed body's frame is the world
    std::optional<Eigen::Vector3d> swept_centre; ///< of a sweep, in the moving body's frame; a screw has none

    /// For a moving body seen from a fixed one that stands still at the origin of the world.
    static MotionEnds between(const Pose& start, const Pose& goal);

    /// For two moving bodies; all poses in the world.
    static MotionEnds relative(const Pose& moving_start, const Pose& moving_goal, const Pose& fixed_start,
                               const Pose& fixed_goal);

    /// The fixed body in the world, along its own screw with uniform turn and slide.
    [[nodiscard]] Pose fixed_pose_at(double time) const;

    /// The moving body in the world at time 0 or before, or at time 1 or after.
    [[nodiscard]] Pose pose_at_end(double time) const;

    /// A pose in the fixed body's frame at a time, in the world.
    [[nodiscard]] Pose in_world(const Pose& pose, double time) const;
};

/// The same with the end poses in the frame of the fixed body, and the motion of the family between them.
struct MotionFrame : MotionEnds {
    using Scalar = algebra::DoubleDouble;
    motion::GeneralPose<Scalar> start;
    motion::GeneralPose<Scalar> goal;
    motion::RationalMotion<Scalar> motion; ///< to be made from start and goal

    MotionFrame() = default;
    explicit MotionFrame(const MotionEnds& ends);
};

} // namespace chasles
