// A rigid frame that moves with time: what trajectories are made of that are no rational motions.
// Source: docs/derivations/24-enclosures.md, "What a trajectory states".
#pragma once

#include "chasles/algebra/bracket.h"
#include "chasles/motion/axis_rates.h"

#include <memory>
#include <type_traits>
#include <vector>

namespace chasles::motion {

struct AxisSection;
class ChainLinks;

/// Poses at any time in [0, 1], and bounds of their rates. A base class, because frames are composed at run time.
class MovingFrame {
public:
    using Wide = algebra::DoubleDouble;

    virtual ~MovingFrame() = default;

    /// The frame at a time, with a quaternion of unit length up to rounding. The error is at most a quarter of
    /// rounding() * pose_rounding.
    [[nodiscard]] virtual GeneralPose<double> at(double time) const = 0;
    /// Likewise in double-double; only if `is_refined()`.
    [[nodiscard]] virtual GeneralPose<Wide> refined_at(const Wide& time) const = 0;
    [[nodiscard]] virtual bool is_refined() const = 0;
    /// The point that the bounds of speed and acceleration are for, in this frame.
    [[nodiscard]] virtual Vector3<double> reference() const = 0;
    /// Likewise in double-double; only if `is_refined()`.
    [[nodiscard]] virtual Vector3<Wide> refined_reference() const = 0;
    /// Bounds during an interval that has no cut inside.
    [[nodiscard]] virtual RateBounds rates(const Bracket& times) const { return expansion(times).bounds; }
    /// Likewise, with the rates in the middle of the interval.
    [[nodiscard]] virtual RateExpansion expansion(const Bracket& times) const = 0;
    /// Likewise, with the rates across a direction of unit length. Empty if the frame does not know them.
    [[nodiscard]] virtual std::optional<AxisExpansion> expansion_about(const Vector3<double>& direction,
                                                                       const Bracket& times) const;
    /// A direction about which alone the frame turns during the interval, while its reference moves evenly along it. It
    /// is of unit length, and off by `axis_rounding` of double-double. Empty if there is none, or the frame does not
    /// know it; only if `is_refined()`.
    [[nodiscard]] virtual std::optional<Vector3<Wide>> refined_axis(const Bracket& /*times*/) const {
        return std::nullopt;
    }
    /// The sum of the sizes of all lengths that enter the poses, mesh unit.
    [[nodiscard]] virtual double size() const = 0;
    /// The error of poses, in units of `pose_rounding`: the number of elementary motions in the frame.
    [[nodiscard]] virtual double rounding() const { return 1; }
    /// The number of frames that are evaluated for one pose.
    [[nodiscard]] virtual int factors() const { return 1; }
    /// Adds the times in (0, 1) at which rates jump.
    virtual void add_cuts(std::vector<double>& /*cuts*/) const {}
    /// The frame as motions about or along one axis each, in order of time from 0 to 1. Empty if it is no such motion,
    /// or is not known to be one.
    [[nodiscard]] virtual std::vector<AxisSection> axis_sections() const;
    /// Adds the links that the frame, or its inverse, is made of. False if it is not made of links.
    [[nodiscard]] virtual bool add_links(ChainLinks& /*chain*/, bool /*is_inverse*/) const { return false; }
};

/// The middle of an interval, and half of its duration.
inline double middle_of(const Bracket& times) {
    return 0.5 * (times.lower + times.upper);
}
inline double half_of(const Bracket& times) {
    return 0.5 * (times.upper - times.lower);
}

/// The frame at a time, in double or in double-double.
template <class S>
GeneralPose<S> pose_of(const MovingFrame& frame, const S& time) {
    if constexpr (std::is_same_v<S, double>)
        return frame.at(time);
    else
        return frame.refined_at(time);
}

using SharedFrame = std::shared_ptr<const MovingFrame>;

/// The pose in double-double, rounded to double.
inline GeneralPose<double> rounded_pose(const GeneralPose<algebra::DoubleDouble>& pose) {
    return {in_double(pose.translation), {double(pose.rotation.w), in_double(pose.rotation.v)}};
}

} // namespace chasles::motion
