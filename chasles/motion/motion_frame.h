// What a motion is made of once two poses are given: exact end poses, and the frame results are reported in.
#pragma once

#include "chasles/motion/pose.h"
#include "chasles/motion/rational_motion.h"

#include <optional>

namespace chasles {

/// An end pose of the moving body as it was given: in the frame of the fixed body, or in the world that `seen_from`
/// stands in.
struct GivenPose {
    Pose pose;
    std::optional<Pose> seen_from;
};

/// End poses of the moving body in the frame of the fixed one, the fixed body's own poses in the world, and the
/// motion of the family between them.
struct MotionFrame {
    using Scalar = algebra::DoubleDouble;
    motion::GeneralPose<Scalar> start;
    motion::GeneralPose<Scalar> goal;
    Pose fixed_start;
    Pose fixed_goal;
    bool fixed_moves = false; ///< if not, the fixed body's frame is the world
    motion::RationalMotion<Scalar> motion;
    GivenPose given_start; ///< what start and goal are rounded from
    GivenPose given_goal;
    std::optional<Eigen::Vector3d> swept_centre; ///< of a sweep, in the moving body's frame; a screw has none

    /// For a moving body seen from a fixed one that stands still at the origin of the world.
    static MotionFrame between(const Pose& start, const Pose& goal);

    /// For two moving bodies; all poses in the world.
    static MotionFrame relative(const Pose& moving_start, const Pose& moving_goal, const Pose& fixed_start,
                                const Pose& fixed_goal);

    /// The fixed body in the world, along its own screw with uniform turn and slide.
    [[nodiscard]] Pose fixed_pose_at(double time) const;

    /// A pose in the fixed body's frame at a time, in the world.
    [[nodiscard]] Pose in_world(const Pose& pose, double time) const;
};

} // namespace chasles
