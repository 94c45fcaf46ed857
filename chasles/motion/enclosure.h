// A cubic motion near a part of any trajectory, with bounds of the distance between both.
// Source: docs/derivations/24-enclosures.md.
#pragma once

#include "chasles/algebra/bracket.h"
#include "chasles/motion/chord_deviation.h"
#include "chasles/motion/rational_motion.h"

#include <cmath>

namespace chasles::motion {

/// Bounds that hold during a part of a trajectory, in the frame of the fixed body and per unit of time. The reference
/// is a point of the moving body. A bound that is not known is infinite.
struct RateBounds {
    double turn_rate = 0;         ///< of the angular velocity, radians
    double turn_acceleration = 0; ///< of the angular acceleration, radians
    double speed = 0;             ///< of the reference, mesh unit
    double acceleration = 0;      ///< of the reference, mesh unit

    /// Bounds for a body point at this distance from the reference. One bound may be infinite and the distance zero.
    [[nodiscard]] double speed_at(double distance) const { return speed + turn_rate * distance; }
    [[nodiscard]] double acceleration_at(double distance) const {
        const double turn = turn_acceleration + turn_rate * turn_rate;
        return acceleration + (distance > 0 ? turn * distance : 0);
    }
};

/// Likewise across and along a direction of the fixed frame, of unit length up to rounding (note 36).
struct AxisRates {
    double turn = 0;              ///< of the angular velocity across the direction, radians
    double turn_acceleration = 0; ///< of the angular acceleration across it, radians
    double acceleration = 0;      ///< of the reference along it, mesh unit
};

/// How far a body point at this distance from the reference is from the straight, even way between its ends.
double deviation_from_straight(const RateBounds& rates, double distance, double duration);

/// A part of a trajectory is enclosed only if its turn is at most this, in radians. So the cubic motion is one of small
/// rotation (`is_small_rotation`) whose maps are made in double.
inline constexpr double most_turn_of_part = 0.25;

/// How far the true motion is from a cubic one over a part, along a direction about which the body all but turns.
struct AxisBounds {
    Vector3<algebra::DoubleDouble>
        axis{};                ///< of unit length up to rounding, in the frame of the fixed body; zero: there is none
    double deviation = 0;      ///< of the reference along it, mesh unit
    double turn_deviation = 0; ///< of a point at the distance 1 from the reference
    double turn = 0;           ///< of the axis as the moving body sees it, radians
};

/// The rounding of directions of unit length, in radians.
template <class S>
inline constexpr double axis_rounding = 0x1p-48;
template <>
inline constexpr double axis_rounding<algebra::DoubleDouble> = 0x1p-94;

/// How far the true motion is from a cubic one over a part, and how far it goes.
struct EnclosureBounds {
    Vector3<double> reference; ///< a point of the moving body
    double travel = 0;         ///< of the reference during the part, mesh unit
    double turn = 0;           ///< of the body during the part, radians
    double deviation = 0;      ///< of the reference, mesh unit
    double turn_deviation = 0; ///< of the orientation: the norm of the difference of rotation matrices is at most this
    double rounding = 0;       ///< the share of `deviation` that shorter parts do not reduce, mesh unit
    double turn_rounding = 0;  ///< likewise of `turn_deviation`
    AxisBounds along{};

    /// A bound of how far any point of a ball of the moving body is from its true place.
    [[nodiscard]] double deviation_of(const Ball& ball) const;
    /// A bound of how far it is along the axis, in the frame of either body.
    [[nodiscard]] double deviation_along_axis(const Ball& ball) const;
    /// The share of it that shorter parts do not reduce.
    [[nodiscard]] double rounding_of(const Ball& ball) const;
    /// A bound of how far any point of the ball moves during the part.
    [[nodiscard]] double travel_of(const Ball& ball) const;
};

/// The sweep between the true poses at both ends of a part. Its parameter is the share of the part's time.
template <class S>
struct Enclosure {
    RationalMotion<S> cubic;
    EnclosureBounds bounds;
};

/// The ends of a part, in the frame of the fixed body.
template <class S>
struct PartEnds {
    GeneralPose<S> start; ///< with quaternions of unit length up to rounding
    GeneralPose<S> goal;
};

/// The error of poses that a trajectory computes, relative to the size of all numbers that enter: quaternions have this
/// error, and translations this times their size. The actual error of a trajectory of the library is at most a quarter
/// of it.
template <class S>
inline constexpr double pose_rounding = 0x1p-46;
template <>
inline constexpr double pose_rounding<algebra::DoubleDouble> = 0x1p-90;

/// The bounds of the enclosure between the ends of a part. `rounding` is that of poses; `size` is the sum of the sizes
/// of all lengths that enter.
EnclosureBounds enclosure_bounds(const Vector3<double>& reference, const RateBounds& rates, double duration,
                                 double rounding, double size);

/// The bounds along a direction, for a part with these bounds. `rounding` is that of the direction.
AxisBounds bounds_along(const Vector3<algebra::DoubleDouble>& axis, const AxisRates& across, double turn_rate,
                        double duration, const EnclosureBounds& part, double rounding);

/// The sweep about the reference, a point of the moving body. The body must turn by less than a half turn.
template <class S>
RationalMotion<S> sweep_between_ends(const PartEnds<S>& ends, const Vector3<S>& reference) {
    using std::sqrt;
    const Quaternion<S> turn = turn_between(ends.start, ends.goal);
    const S inverse = S(1) / sqrt(turn.squared_norm());
    return sweep_between(ends.start, ends.goal, {turn.w * inverse, scale(turn.v, inverse)}, reference);
}

} // namespace chasles::motion
