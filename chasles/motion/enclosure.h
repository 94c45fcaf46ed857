// A cubic motion near a part of any trajectory, with bounds of the distance between both.
// Source: docs/derivations/24-enclosures.md.
#pragma once

#include "chasles/algebra/bracket.h"
#include "chasles/motion/chord_deviation.h"
#include "chasles/motion/rational_motion.h"

namespace chasles::motion {

/// Bounds that hold during a part of a trajectory, in the frame of the fixed body and per unit of time. The reference
/// is a point of the moving body. A bound that is not known is infinite.
struct RateBounds {
    double turn_rate;         ///< of the angular velocity, radians
    double turn_acceleration; ///< of the angular acceleration, radians
    double speed;             ///< of the reference, mesh unit
    double acceleration;      ///< of the reference, mesh unit
};

/// A part of a trajectory is enclosed only if its turn is at most this, in radians. So the cubic motion is one of small
/// rotation (`is_small_rotation`) whose maps are made in double.
inline constexpr double most_turn_of_part = 0.25;

/// The sweep between the true poses at both ends of a part, and how far the true motion is from it at any time. The
/// parameter of the sweep is the share of the part's time.
struct Enclosure {
    RationalMotion<double> cubic;
    Vector3<double> reference; ///< a point of the moving body
    double travel = 0;         ///< a bound of how far the reference moves during the part, mesh unit
    double turn = 0;           ///< a bound of how far the body turns during the part, radians
    double deviation = 0;      ///< of the reference, mesh unit
    double turn_deviation = 0; ///< of the orientation: the norm of the difference of rotation matrices is at most this
    double rounding = 0;       ///< the share of `deviation` that shorter parts do not reduce, mesh unit
    double turn_rounding = 0;  ///< likewise of `turn_deviation`

    /// A bound of how far any point of a ball of the moving body is from its true place.
    [[nodiscard]] double deviation_of(const Ball& ball) const;
    /// The share of it that shorter parts do not reduce.
    [[nodiscard]] double rounding_of(const Ball& ball) const;
    /// A bound of how far any point of the ball moves during the part.
    [[nodiscard]] double travel_of(const Ball& ball) const;
};

/// The ends of a part, in the frame of the fixed body.
struct PartEnds {
    GeneralPose<double> start; ///< with quaternions of unit length up to rounding
    GeneralPose<double> goal;
    double duration; ///< in the unit of time of the bounds
};

/// The error of poses that are computed in double, relative to the size of all numbers that enter: quaternions have
/// this error, and translations this times their size. The actual error of a trajectory of the library is at most a
/// quarter of it.
inline constexpr double pose_rounding = 0x1p-46;

/// `size` is the sum of the sizes of all lengths that enter. The body must turn by less than a half turn.
Enclosure enclosure_between(const PartEnds& ends, const Vector3<double>& reference, const RateBounds& bounds,
                            double size);

} // namespace chasles::motion
