// Poses with time stamps as one motion: a recorded or planned track.
#pragma once

#include "chasles/algebra/bracket.h"
#include "chasles/motion/motion.h"

#include <cstdint>
#include <vector>

namespace chasles {

/// A track through poses, each with a time stamp. From pose to pose the body moves evenly. The track is one motion: its
/// time in [0, 1] runs evenly from the first stamp to the last. Source: docs/derivations/26-frames.md, "Tracks".
class CHASLES_EXPORT TimedPoses {
public:
    /// What lies between two poses.
    enum class Between : std::uint8_t {
        velocity, ///< ConstantVelocity: slerp, while a point of the body moves straight
        twist     ///< ConstantTwist: a uniform helix
    };

    /// Stamps are in any unit of time. `centre` is the point that moves straight, in the moving body's frame; without
    /// effect for a twist. Throws InvalidInput for fewer than two poses, for another number of stamps, for stamps that
    /// are not finite or do not ascend, and for a pose or a centre that cannot be used.
    static TimedPoses through(std::vector<double> stamps, const std::vector<Pose>& poses,
                              Between between = Between::velocity,
                              const Eigen::Vector3d& centre = Eigen::Vector3d::Zero());

    /// A bracket of the motion's time as a bracket of stamps, rounded outward.
    [[nodiscard]] Bracket stamp_of(const Bracket& time) const;
    /// The time of a stamp, in [0, 1], rounded.
    [[nodiscard]] double time_of(double stamp) const;
    /// The segment, from 0, that holds a time. A time between two segments belongs to the earlier one.
    [[nodiscard]] std::size_t segment_of(double time) const;
    [[nodiscard]] const std::vector<double>& stamps() const { return stamps_; }
    [[nodiscard]] Pose pose_at(double time) const { return motion_.pose_at(time); } ///< time in [0, 1]

    operator Motion() const { return motion_; } // NOLINT(google-explicit-constructor): a query takes any motion

private:
    TimedPoses(std::vector<double> stamps, Motion motion) : stamps_(std::move(stamps)), motion_(std::move(motion)) {}

    std::vector<double> stamps_;
    Motion motion_;
};

} // namespace chasles
