// One rational motion in double that stays near a whole trajectory. It proves that bodies stay clearly apart before any
// number of the true motion is computed. Source: docs/derivations/23-coarse-motion.md.
#pragma once

#include "chasles/motion/enclosure.h"
#include "chasles/motion/matrix_pose.h"
#include "chasles/motion/motion_ends.h"
#include "chasles/motion/rational_motion.h"

#include <optional>

namespace chasles::motion {

/// A motion over tau in [0, 1]. It has its own clock: the trajectory's order of poses is kept, its times are not.
struct CoarseMotion {
    RationalMotion<double> path;
    /// A bound of the distance between a point, seen from the other body, in the trajectory and in the path. Rounding
    /// is not included.
    double deviation = 0;
    /// The sum of the sizes of everything that enters. With the sizes of the bodies, it bounds roundings (2^-30 of the
    /// sum).
    double size = 0;
    /// Of the orientation, in radians: points of the moving body deviate by this times their distance to `reference`,
    /// in addition.
    double turn_deviation = 0;
    Vector3<double> reference{};
    // At the start, at tau = 0, both deviations are no more than these.
    double start_deviation = 0;
    double start_turn_deviation = 0;
};

/// The rounding of a coarse motion over the sum of all sizes: CoarseMotion::size and the sizes of the bodies. The
/// actual rounding is below a thousandth of it.
inline constexpr double coarse_rounding = 0x1p-30;

/// A screw in any number of pieces. Empty if it turns by more than 90 degrees.
std::optional<CoarseMotion> coarse_screw(const MotionEnds& given);

/// The sweep about a point of the moving body. Empty if it turns by more than 90 degrees.
std::optional<CoarseMotion> coarse_sweep(const MotionEnds& given, const Vector3<double>& centre);

/// What a part of a smooth motion states, to be enclosed by one sweep.
struct CoarsePart {
    PartEnds<double> ends;
    Vector3<double> reference; ///< of the rates, in the moving body's frame
    RateBounds rates;
    double duration;
    double rounding; ///< of both ends
    double size;     ///< the sum of the sizes of all lengths that enter
};

/// The sweep between the ends of a part. Empty if the part may turn by more than 90 degrees.
std::optional<CoarseMotion> coarse_part(const CoarsePart& part);

/// The position at a tau of a motion in double.
MatrixPose position_at(const RationalMotion<double>& path, double tau);

} // namespace chasles::motion
